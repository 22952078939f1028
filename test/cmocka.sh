#!/bin/sh
# SPDX-License-Identifier: MIT
# Sees to it that cmocka is there for compiler $1: found, or installed, or one line that says how.
has_cmocka() {
    printf '%s\n' '#include <stdarg.h>' '#include <stddef.h>' '#include <stdint.h>' \
        '#include <setjmp.h>' '#include <cmocka.h>' 'int main(void) { return 0; }' |
        "$1" -x c - -o /dev/null -lcmocka 2>/dev/null
}
has_cmocka "$1" && exit 0
if [ "$(id -u)" = 0 ]; then as_root=; else as_root='sudo -n'; fi
{ $as_root apt-get update && $as_root apt-get install -y libcmocka-dev; } >/dev/null 2>&1
has_cmocka "$1" && exit 0
echo "make test needs cmocka; install it with: sudo apt-get install libcmocka-dev" >&2
exit 1
