#!/bin/sh
# SPDX-License-Identifier: MIT
# Checks the core against MISRA C:2012, as far as cppcheck's addon does, and prints how often each rule
# is violated. Fails on a rule that test/misra.md does not list as a deviation, and on a listed one
# that is not violated.
# usage: misra.sh BUILD    (in the root; what the addon writes for each file goes under BUILD)
if ! command -v cppcheck >/dev/null; then
    echo 'misra needs cppcheck; install it with: sudo apt-get install cppcheck' >&2
    exit 1
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
# without the results of a former run, which cppcheck would reuse
dumps=$1/misra
rm -rf "$dumps"
mkdir -p "$dumps" || exit 1

cppcheck --quiet -j "$(getconf _NPROCESSORS_ONLN)" --std=c11 --addon=misra --template='{file}:{line} {id}' \
    --cppcheck-build-dir="$dumps" -Iinclude -Isrc \
    src/base src/mesh src/optics src/scene src/view src/visibility src/integrate >"$work/all" 2>&1
# a line of a header is reported once for every file that includes it
sed -n 's/ misra-c2012-/ /p' "$work/all" | LC_ALL=C sort -u >"$work/found"
if [ ! -s "$work/found" ]; then
    echo 'misra: cppcheck found nothing at all: has it its addon?' >&2
    cat "$work/all" >&2
    exit 1
fi
sed -n 's/^| \([0-9]*\.[0-9]*\) |.*/\1/p' test/misra.md | LC_ALL=C sort >"$work/listed"
awk '{ print $2 }' "$work/found" | LC_ALL=C sort | uniq -c | LC_ALL=C sort -rn >"$work/counts"
awk '{ print $2 }' "$work/counts" | LC_ALL=C sort >"$work/broken"

sed 's/^ *\([0-9]*\) \(.*\)/rule \2: \1/' "$work/counts"
bad=0
for rule in $(LC_ALL=C comm -23 "$work/broken" "$work/listed"); do
    echo "misra: rule $rule is broken, and test/misra.md has no reason:" >&2
    awk -v rule="$rule" '$2 == rule { print "  " $1 }' "$work/found" >&2
    bad=1
done
for rule in $(LC_ALL=C comm -13 "$work/broken" "$work/listed"); do
    echo "misra: test/misra.md lists rule $rule, which nothing breaks" >&2
    bad=1
done
[ $bad -eq 0 ] && echo "misra: $(wc -l <"$work/broken") rules with deviations, each with its reason in test/misra.md"
exit $bad
