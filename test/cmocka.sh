#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes sure that cmocka is available for compiler $1: finds or installs it, or prints how to install it.
if ! command -v "$1" >/dev/null; then
    echo "make test needs the compiler $1; install it with: sudo apt-get install gcc" >&2
    exit 1
fi
out=$(mktemp) || exit 1
trap 'rm -f "$out"' EXIT
has_cmocka() {
    printf '%s\n' '#include <stdarg.h>' '#include <stddef.h>' '#include <stdint.h>' \
        '#include <setjmp.h>' '#include <cmocka.h>' 'int main(void) { return 0; }' |
        "$1" -x c - -o "$out" -lcmocka 2>/dev/null
}
has_cmocka "$1" && exit 0
if [ "$(id -u)" = 0 ]; then as_root=; else as_root='sudo -n'; fi
{
    $as_root apt-get update
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y libcmocka-dev
} >/dev/null 2>&1 </dev/null
has_cmocka "$1" && exit 0
echo "make test needs cmocka; install it with: sudo apt-get install libcmocka-dev" >&2
exit 1
