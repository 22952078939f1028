#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs every test given, C programs and shell scripts, and closes with one line of counts.
# Tests that lack what they need (models that are not part of the project) skip, and say so.
# As many at a time as there are processors; told in the order given.
# usage: run.sh TOOL TEST...
tool=$1
shift
passed=0
failed=0
skipped=0
logs=$(mktemp -d) || exit 1
trap 'rm -rf "$logs"' EXIT
# one test: its output and its exit status, in files named after it
one='name=$2/$(echo "$3" | tr / _)
case $3 in
*.sh) sh "$3" "$1" ;;
*) "$3" ;;
esac >"$name" 2>&1
echo $? >"$name.status"'
printf '%s\n' "$@" | xargs -n 1 -P "$(getconf _NPROCESSORS_ONLN)" sh -c "$one" sh "$tool" "$logs"
for test in "$@"; do
    log=$logs/$(echo "$test" | tr / _)
    status=$(cat "$log.status")
    good=$(grep -cE '^(\[       OK \]|ok )' "$log")
    # cmocka names a failed test twice
    bad=$(grep -E '^(\[  FAILED  \] [a-z0-9_]+$|not ok )' "$log" | sort -u | grep -c .)
    # and a skipped one once as it skips, once in its summary
    skip=$(grep -E '^(\[  SKIPPED \] [a-z0-9_]+$|skip )' "$log" | sort -u | grep -c .)
    if [ "$status" -eq 0 ] && [ "$bad" -eq 0 ] && [ "$((good + skip))" -gt 0 ]; then
        note=
        [ "$skip" -eq 0 ] || note=", $skip skipped: $(grep -vE '^(\[| *$| *[0-9])' "$log" | sed -n 1p)"
        echo "ok   $test ($good$note)"
    else
        [ "$bad" -gt 0 ] || bad=1
        echo "FAIL $test (exit $status)"
        cat "$log"
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
    skipped=$((skipped + skip))
done
[ "$skipped" -eq 0 ] || echo "$skipped skipped"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
