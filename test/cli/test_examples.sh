#!/bin/sh
# SPDX-License-Identifier: MIT
# Each program in examples/ prints what the comment at its end says.
. "$(dirname "$0")/check.sh"
build=$(dirname "$tool")
for source in "$root"/examples/*.c; do
    name=$(basename "$source" .c)
    want=$(sed -n '/^\/\* expected output:$/,/^\*\/$/p' "$source" | sed '1d;$d')
    got=$("$build/examples/$name" 2>&1)
    if [ -n "$want" ] && [ "$got" = "$want" ]; then
        ok "$name"
    else
        not_ok "$name" "got '$got', want '$want'"
    fi
done
finish
