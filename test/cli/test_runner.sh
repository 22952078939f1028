#!/bin/sh
# SPDX-License-Identifier: MIT
# The test runner: a clone without the models skips their tests and passes; a failing test is reported,
# and so is a program that ends before it has run all the tests of its plan.
. "$(dirname "$0")/check.sh"
mkdir "$scratch/tests"
# expect NAME STATUS LINE: run.sh on the programs exits so, and prints the line
expect() {
    said=$(sh "$root/test/run.sh" tool "$scratch"/tests/*)
    got=$?
    if [ "$got" -eq "$2" ] && printf '%s\n' "$said" | grep -qF -- "$3"; then
        ok "$1"
    else
        not_ok "$1" "exit $got, and printed $said"
    fi
}
program() {
    printf '#!/bin/sh\ncat <<end\n%s\nend\nexit %s\n' "$2" "$3" >"$scratch/tests/$1"
    chmod +x "$scratch/tests/$1"
}
program good '1..1
ok 1 - fact' 0
program models '1..2
no models
not ok 1 # SKIP a
no models
not ok 2 # SKIP b' 0
expect skipped_tests_do_not_fail 0 "(0, 2 skipped: no models)"
expect skipped_tests_do_not_count_as_passed 0 "1 passed, 0 failed"
program script '1..1
ok b # SKIP no such program' 0
expect scripts_say_why_they_skip 0 "(0, 1 skipped: no such program)"
rm "$scratch/tests/script"
program other '' 0
expect a_program_without_a_test_fails 1 "1 passed, 1 failed"
program other '1..1
ok 1 - fact' 1
expect a_program_that_exits_1_fails 1 "2 passed, 1 failed"
program other '1..2
ok 1 - fact' 0
expect a_program_that_stops_early_fails 1 "2 passed, 1 failed"
program other '1..1
not ok 1 - fact' 0
expect a_program_that_says_so_fails 1 "1 passed, 1 failed"
rm "$scratch/tests/other" "$scratch/tests/good"
expect nothing_but_skipped_fails 1 "0 passed, 0 failed"
finish
