#!/bin/sh
# SPDX-License-Identifier: MIT
# The README's worked example is what the tool prints today, but for times and the picture's name;
# and every make target that it names exists.
. "$(dirname "$0")/check.sh"
untimed() { grep -vE '^(time|picture) '; }
want=$(sed -n '/^scene        demo/,/^```$/p' "$root/README.md" | sed '$d' | untimed)
got=$("$tool" run demo --azel 50,40 2>/dev/null | untimed)
if [ -n "$want" ] && [ "$got" = "$want" ]; then
    ok readme_example_is_current
else
    not_ok readme_example_is_current "the tool prints $got"
fi
for target in $(grep -oE '\bmake [a-z]+' "$root/README.md" | cut -d' ' -f2 | sort -u); do
    if grep -qE "^$target:" "$root/Makefile"; then
        ok "readme_target_$target"
    else
        not_ok "readme_target_$target" "no such target"
    fi
done
finish
