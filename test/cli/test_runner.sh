#!/bin/sh
# SPDX-License-Identifier: MIT
# The test runner: a clone without the models skips their tests and passes; what fails, fails.
here=$(dirname "$0")/..
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
bad=0
# expect NAME STATUS LINE: run.sh on $scratch/* exits so, and prints the line
expect() {
    out=$(sh "$here/run.sh" tool "$scratch"/*)
    got=$?
    if [ "$got" -eq "$2" ] && printf '%s\n' "$out" | grep -qF -- "$3"; then
        echo "ok $1"
    else
        printf 'not ok %s: exit %s\n' "$1" "$got"
        printf '%s\n' "$out" | sed 's/^/  /' # else its lines would count as this test's
        bad=1
    fi
}
program() {
    printf '#!/bin/sh\ncat <<end\n%s\nend\nexit %s\n' "$2" "$3" >"$scratch/$1"
    chmod +x "$scratch/$1"
}
program good '[       OK ] fact' 0
program models 'no models
[  SKIPPED ] a
[  SKIPPED ] b
[  SKIPPED ] a
[  SKIPPED ] b' 0
expect skipped_tests_do_not_fail 0 "(0, 2 skipped: no models)"
expect skipped_tests_do_not_count_as_passed 0 "1 passed, 0 failed"
program silent '' 0
expect a_program_without_a_test_fails 1 "1 passed, 1 failed"
program silent '[       OK ] fact' 1
expect a_program_that_exits_1_fails 1 "2 passed, 1 failed"
rm "$scratch/silent" "$scratch/good"
expect nothing_but_skipped_fails 1 "0 passed, 0 failed"
exit $bad
