#!/bin/sh
# SPDX-License-Identifier: MIT
# clang-tidy and cppcheck over src, clang-format over all C files but generated tables, the length
# of lines. Installs nothing. Exit 1 if one of them reports anything, or is missing.
# usage: lint.sh [BUILD]    (in the root; BUILD holds what is generated)
build=${1:-build}
bad=0
for tool in clang-tidy cppcheck clang-format; do
    if ! command -v $tool >/dev/null; then
        echo "lint needs $tool; install it with: sudo apt-get install $tool" >&2
        bad=1
    fi
done
[ $bad -eq 0 ] || exit 1

log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT

# Its analyzer takes nine tenths of the time. In long functions it stops at a number of states: 100,000
# reach the same blocks of code as its default of 225,000, in half the time; 50,000 do not.
echo 'lint: clang-tidy over src (.clang-tidy says which checks, and why not the others)'
if ! find src -name '*.c' | LC_ALL=C sort | xargs -P 2 -I FILE clang-tidy --quiet FILE -- \
    -std=c11 -ffp-contract=off -D_XOPEN_SOURCE=700 -Iinclude -Isrc "-I$build" \
    -Xclang -analyzer-config -Xclang max-nodes=100000 >"$log" 2>&1; then
    grep -E ': (warning|error):' "$log" | LC_ALL=C sort -u >&2 || cat "$log" >&2
    bad=1
fi

# Left out: unusedFunction, which reports public functions of a library. Suppressed: members that give a union its
# alignment or wait for the library's user, and conditions that hold only on the path it imagines.
echo 'lint: cppcheck over src'
cppcheck --quiet -j 2 --std=c11 --enable=warning,style,performance,portability --inline-suppr \
    --suppress=unusedStructMember --suppress=knownConditionTrueFalse \
    --error-exitcode=1 -Iinclude -Isrc src >&2 || bad=1

echo 'lint: clang-format over src include test examples'
folders=
for folder in src include test examples; do
    [ ! -d $folder ] || folders="$folders $folder"
done
if ! find $folders -name '*.[ch]' | LC_ALL=C sort |
    xargs clang-format --dry-run -Werror >"$log" 2>&1; then
    sed -n 's/: error: code should be clang-formatted.*//p' "$log" | cut -d: -f1 | LC_ALL=C sort -u |
        sed 's/^/not formatted (clang-format -i FILE): /' >&2
    grep -q 'should be clang-formatted' "$log" || cat "$log" >&2
    bad=1
fi

# The formatter leaves comments as they are.
echo 'lint: lines of at most 100 columns in src and include'
if ! find src include -name '*.[ch]' | LC_ALL=C sort |
    xargs awk 'length($0) > 100 { print FILENAME ":" FNR ": " length($0) " columns"; long = 1 }
        END { exit long }' >&2; then
    bad=1
fi
[ $bad -eq 0 ] && echo 'lint: clean'
exit $bad
