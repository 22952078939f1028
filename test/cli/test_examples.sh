#!/bin/sh
# SPDX-License-Identifier: MIT
# Each program in examples/ prints what the comment at its end says.
here=$(dirname "$0")/../..
build=$(dirname "$1")
bad=0
for source in "$here"/examples/*.c; do
    name=$(basename "$source" .c)
    want=$(sed -n '/^\/\* expected output:$/,/^\*\/$/p' "$source" | sed '1d;$d')
    got=$("$build/examples/$name" 2>&1)
    if [ -n "$want" ] && [ "$got" = "$want" ]; then
        echo "ok $name"
    else
        echo "not ok $name: got '$got', want '$want'"
        bad=1
    fi
done
exit $bad
