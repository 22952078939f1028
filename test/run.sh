#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs every test given, C programs and shell scripts, and closes with one line of counts.
# usage: run.sh TOOL TEST...
tool=$1
shift
passed=0
failed=0
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
for test in "$@"; do
    case $test in
    *.sh) sh "$test" "$tool" >"$log" 2>&1 ;;
    *) "$test" >"$log" 2>&1 ;;
    esac
    status=$?
    good=$(grep -cE '^(\[       OK \]|ok )' "$log")
    # cmocka names a failed test twice
    bad=$(grep -E '^(\[  FAILED  \] [a-z0-9_]+$|not ok )' "$log" | sort -u | grep -c .)
    if [ "$status" -eq 0 ] && [ "$bad" -eq 0 ] && [ "$good" -gt 0 ]; then
        echo "ok   $test ($good)"
    else
        [ "$bad" -gt 0 ] || bad=1
        echo "FAIL $test (exit $status)"
        cat "$log"
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
