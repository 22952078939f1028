#!/bin/sh
# SPDX-License-Identifier: MIT
# The README's worked example is what the tool prints today, but for times and the picture's name;
# and every make target that it names exists.
here=$(dirname "$0")/../..
same() { grep -vE '^(time|picture) '; }
want=$(sed -n '/^scene        demo/,/^```$/p' "$here/README.md" | sed '$d' | same)
got=$("$1" run demo --azel 50,40 2>/dev/null | same)
bad=0
if [ -n "$want" ] && [ "$got" = "$want" ]; then
    echo "ok readme_example_is_current"
else
    echo "not ok readme_example_is_current: the tool prints"
    echo "$got"
    bad=1
fi
for target in $(grep -oE '\bmake [a-z]+' "$here/README.md" | cut -d' ' -f2 | sort -u); do
    if grep -qE "^$target:" "$here/Makefile"; then
        echo "ok readme_target_$target"
    else
        echo "not ok readme_target_$target: no such target"
        bad=1
    fi
done
exit $bad
