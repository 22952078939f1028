#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run --explain, and why a method was chosen.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
printf '[[part]]\nname = "a"\nshape = "box"\nsize = [1, 2, 3]\nmaterial = "paint-white"\n' >box.toml
cat box.toml >pair.toml
printf '[[part]]\nname = "b"\nshape = "box"\nsize = [3, 1, 1]\ntranslate = [0.3, 0.2, -4]\n' >>pair.toml

# effect NAME: its JSON object in $out.
effect() { printf '%s\n' "$out" | grep "\"name\": \"$1\""; }
# part KEY: a value out of such an object on stdin.
part() { sed "s/.*\"$1\": \([^,}]*\)[,}].*/\1/"; }

# ---- JSON ----
run run box.toml --direction 1,1,1 --json
same without_explain_no_further_keys "$(printf '%s\n' "$out" | grep -cE 'sigma_m2_flipped|"share"')" 0
plain=$(printf '%s\n' "$out" | grep -v '"seconds": {\|"options"')
run run box.toml --direction 1,1,1 --json --explain
same explain_exits_0 "$rc" 0
same explain_adds_three_keys_to_each_effect "$(printf '%s\n' "$out" | grep -cE '"reason": "[^"]+", "seconds": [^,]+, "share": [^,]+, "sigma_m2_flipped": [^,]+\},?$')" 8
same explain_changes_nothing_else "$(printf '%s\n' "$out" | sed 's/, "seconds": [^{]*, "share".*}/}/' | grep -v '"seconds": {\|"options"')" "$plain"
seconds=$(printf '%s\n' "$out" | grep '"seconds": {"load"')
same explain_adds_the_stages_of_preparing "$(printf '%s\n' "$seconds" | grep -cE '"prepare_stages": \{"edges": [^,]+, "neighbours": [^,]+, "contacts": [^,]+, "normals": [^,]+, "proofs": [^,]+\}')" 1
same and_of_the_pose "$(printf '%s\n' "$seconds" | grep -cE '"pose_stages": \{"view": [^,]+, "classify": [^,]+, "visibility": [^,]+, "sum": [^,]+\}')" 1
same stages_of_preparing_are_part_of_it "$(printf '%s\n' "$seconds" | sed 's/"[a-z_]*": //g; s/[{}]//g' | awk -F, '{all = $4 + $5 + $6 + $7 + $8; print (all > 0 && all <= $2) + 0}')" 1
for name in curved_normals articulation; do
    same "${name}_is_nothing_that_a_run_switches" "$(effect $name | grep -c '"seconds": null, "share": null, "sigma_m2_flipped": null')" 1
done
sigma=$(value sigma_m2)
for name in self_shadowing back_face_casters two_sided; do
    same "${name}_is_off_for_a_box" "$(effect $name | part on)" false
    near "${name}_would_not_change_sigma" "$(effect $name | part sigma_m2_flipped)" "$sigma"
done
near without_glint_the_diffuse_part_is_left "$(effect glint | part sigma_m2_flipped)" "$(value sigma_diffuse_m2)"
near without_diffuse_the_glint_is_left "$(effect diffuse | part sigma_m2_flipped)" "$(value sigma_glint_m2)"

# ---- the table ----
run run pair.toml --explain
table=$(printf '%s\n' "$out" | sed -n '/^explained /,$p')
same the_table_has_a_row_for_every_effect "$(printf '%s\n' "$table" | grep -cE '^  (self_shadowing|back_face_casters|glint|diffuse|curved_normals|two_sided|articulation|closed_forms) +(on|off) ')" 8
same the_table_fits_100_columns "$(printf '%s\n' "$table" | awk 'length($0) > 100' | wc -l | tr -d ' ')" 0
same stages_end_the_table "$(printf '%s\n' "$table" | sed '/^verdict/,$d' | tail -3 | head -1 | grep -cE '^stages +load and joints [0-9.]+ ms \([0-9.]+ %\), prepare [0-9.]+ ms \([0-9.]+ %\), pose [0-9.]+ ms \([0-9.]+ %\)$')" 1
number='(< )?[0-9.]+'
same those_of_preparing_come_after "$(printf '%s\n' "$table" | sed '/^verdict/,$d' | tail -2 | head -1 | grep -cE "^  prepare +edges $number, neighbours $number, contacts $number, normals $number, proofs $number ms\$")" 1
same and_those_of_the_pose "$(printf '%s\n' "$table" | sed '/^verdict/,$d' | tail -1 | grep -cE "^  pose +view $number, classify $number, visibility $number, adding up $number ms\$")" 1
same shadows_left_out_add_to_sigma "$(printf '%s\n' "$table" | grep '^  self_shadowing ' | grep -cE '\+[0-9.]+ %')" 1
usage_error explain_and_facets_both_on_stdout "both want standard output" run box.toml --explain --facets -

# ---- why this method ----
# method_line ARGUMENTS...: the table's line on the method, which JSON repeats.
method_line() {
    run run "$@"
    said=$(printf '%s\n' "$out" | sed -n 's/^method  *//p')
    run run "$@" --json
    why=$(value method_reason | tr -d '"')
    case $said in *"$why)") ;; *) said="$said, but JSON says '$why'" ;; esac
}
method_line box.toml
same facet_says_why "$said" "facet (chosen by auto: proved a single convex body: nothing is hidden)"
method_line pair.toml
same exact_says_why "$said" "exact (chosen by auto: not proved a single convex body; clipping has the closest bound)"
method_line pair.toml --resolution 512 --tolerance 0.5
same a_raster_that_is_enough_says_so "$said" "zbuffer, 512 x 512 (chosen by auto: a raster of this size is requested)"
method_line pair.toml --resolution 16
same a_raster_that_is_not_enough_yields "$said" "exact (chosen by auto: the requested raster misses the tolerance)"
method_line pair.toml --method zbuffer --resolution 64
same a_method_asked_for_says_so "$said" "zbuffer, 64 x 64 (as requested)"

# ---- the tolerance ----
for tolerance in 0.5 1e-2 1e-4 1e-8; do
    run run pair.toml --direction 0.1,0.2,1 --tolerance $tolerance --json
    same "auto_meets_${tolerance}_and_exits_0" "$rc $(value tolerance | part met)" "0 true"
done
run run pair.toml --direction 0.1,0.2,1 --json
best=$(value sigma_m2)
run run pair.toml --direction 0.1,0.2,1 --tolerance 1e-16 --json
same an_unreachable_tolerance_exits_3 "$rc $(value tolerance | part met)" "3 false"
same it_gives_the_best_answer_all_the_same "$(value sigma_m2) $(value method)" "$best \"exact\""
same its_flag_says_so "$(value flags)" '["tolerance_not_met"]'
finish
