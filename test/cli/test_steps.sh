#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run --steps: a run that ends there says so, and its bound holds what the whole run finds.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
pair_scene >pair.toml

for bad in 0 -5 1.5 1e10 x ''; do
    usage_error "steps_of_'${bad}'_are_refused" "--steps" run pair.toml --steps "$bad"
done
usage_error time_and_steps_are_not_both_counted "leave out --steps" run pair.toml --time-budget 9 --steps 9
usage_error hardware_is_not_counted "--steps" run pair.toml --precision float32 --steps 9

# part NAME: of "steps" in $out.
part() { value steps | sed -n "s/.*\"$1\": \([0-9]*\).*/\1/p"; }
run run pair.toml --direction 1,2,5 --method exact --steps 4000000000 --json
same a_run_that_has_enough_is_done "$rc $(value flags)" '0 []'
taken=$(part taken)
sigma=$(value sigma_m2)
run run pair.toml --direction 1,2,5 --method exact --json
same it_is_the_run_without "$(value sigma_m2)" "$sigma"
same which_does_not_tell "$(value steps)" ''

run run pair.toml --direction 1,2,5 --method exact --steps $((taken - 1)) --json
same a_run_that_has_not_says_so "$rc $(value flags)" '0 ["steps_spent"]'
same it_says_how_many_were_asked "$(part asked)" $((taken - 1))
same its_bound_holds_the_rest "$(awk -v a="$(value sigma_m2)" -v b="$(value bound_m2)" -v c="$sigma" \
    'BEGIN { print (a - c <= b && c - a <= b) }')" 1
run run pair.toml --direction 1,2,5 --steps 1 --json
same where_the_tolerance_counts_it_is_degraded "$rc" 3
run run pair.toml --direction 1,2,5 --steps 1
same the_table_tells_too "$(printf '%s\n' "$out" | grep -cE '^(steps        [01] of at most 1|flag         steps_spent)$')" 2
finish
