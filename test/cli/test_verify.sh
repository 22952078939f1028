#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs verify: every case within its bound, and both forms say so; --hard: right where the plain
# formula is not, by references that test/vectors/hard.py made.
. "$(dirname "$0")/check.sh"

run verify --json
same verify_exits_0 "$rc" 0
same verify_keys_in_order "$(keys)" "schema version cases count failed worst_error_over_bound "
same no_case_failed "$(value failed)" 0
same every_case_is_listed "$(printf '%s\n' "$out" | grep -c '"ok": true')" "$(value count)"
same all_shapes_are_tried "$(printf '%s\n' "$out" | sed -n 's/^    {"shape": "\([a-z]*\)".*/\1/p' | sort -u | wc -l | tr -d ' ')" 9
count=$(value count)
run verify
same table_has_a_row_for_every_case "$(printf '%s\n' "$out" | wc -l | tr -d ' ')" "$((count + 2))"
same no_row_says_fail "$(printf '%s\n' "$out" | grep -c FAIL)" 0

run verify --hard
same hard_exits_0 "$rc" 0
same hard_fits_into_100_columns "$(printf '%s\n' "$out" | awk 'length > 100' | wc -l | tr -d ' ')" 0
same no_hard_row_says_fail "$(printf '%s\n' "$out" | grep -c FAIL)" 0
lines=$(printf '%s\n' "$out" | wc -l | tr -d ' ')
run verify --hard --json
same hard_json_exits_0 "$rc" 0
same hard_keys_in_order "$(keys)" "schema version cases count failed "
same hard_table_has_a_row_for_every_case "$lines" "$(($(value count) + 2))"
same no_hard_case_failed "$(value failed)" 0
same every_hard_case_is_ok "$(printf '%s\n' "$out" | grep -c '"ok": true')" "$(value count)"

# field CASE KEY: what the JSON says of it.
field() { printf '%s\n' "$out" | sed -n "s/.*\"case\": \"$1\".*\"$2\": \"\{0,1\}\([^\",}]*\).*/\1/p"; }

for case in 'sphere, s = 0.02' 'cylinder broadside, m = 10000' 'cylinder wall seen end-on' \
    'paraboloid, m = 1' 'plate 1e-60 rad from edge-on' 'facet of no area' 'box of 2^-500 m'; do
    same "plain_formula_gives_nan: $case" "$(field "$case" naive)" nan
done
for case in 'sliver of aspect 1e8, Heron' 'box of 2^300 m'; do
    same "plain_formula_gives_nothing: $case" "$(field "$case" naive)" 0
done
for case in 'a coordinate NaN' 'a coordinate of 1e308 m' 'a plate beyond 1e100 m'; do
    same "engine_refuses: $case" "$(field "$case" engine_m2)" null
done
# Off by more than a thousandth of the reference, where it is not nan.
for case in 'cylinder broadside, s = 0.0001' 'cone along its side, s = 0.001' \
    'L-bracket, 3\/8 in shadow' 'comb of 40 fins' 'plates that cross' 'facets given twice' \
    'two plates that share a quarter' 'skins one ulp apart' 'wholly behind a screen'; do
    wrong=$(awk -v a="$(field "$case" naive)" -v b="$(field "$case" reference_m2)" \
        'BEGIN { d = a - b; print (a != "" && b != "" && d * d > 1e-6 * b * b) }')
    same "plain_formula_is_far_off: $case" "$wrong" 1
done
# The references are those of hard.inc, to the bit.
printf '%s\n' "$out" |
    sed -n 's/.*"case": "\([^"]*\)".*"reference_m2": \([-+.e0-9]*\),.*/\1=\2/p' >"$scratch/told"
sed -n 's/^{"\(.*\)", \(.*\)},$/\1=\2/p' "$root/test/vectors/hard.inc" >"$scratch/made"
wrong=$(awk -F= '{ v = $NF; sub(/=[^=]*$/, "") } NR == FNR { made[$0] = v + 0; next }
    !($0 in made) || made[$0] != v + 0 { print $0 }' "$scratch/made" "$scratch/told")
same references_are_those_made_at_50_digits "$wrong" ""
same all_answered_cases_have_one "$(wc -l <"$scratch/told" | tr -d ' ')" "$(($(value count) - 3))"
finish
