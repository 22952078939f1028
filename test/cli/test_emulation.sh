#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run --precision and --depth-bits: hardware emulated, beside the reference that bounds it.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
pair_scene >pair.toml
{ plates_scene && echo 'material = "paint-white"'; } >plates.toml # the upper one
printf '[[part]]\nname = "b"\nshape = "sphere"\nradius = 1\n' >ball.toml

# ---- wrong arguments ----
usage_error a_precision_is_one_of_two "expected float32 or float64, found 'half'" run pair.toml --precision half
for bad in 8 64 24.5 x ''; do
    usage_error "a_depth_of_'${bad}'_bits_is_refused" "--depth-bits" run pair.toml --depth-bits "$bad"
done
usage_error hardware_has_a_z_buffer "--precision needs --method zbuffer" run pair.toml --precision float32 --method exact
usage_error hardware_shades_flat "--depth-bits needs --normals flat" run pair.toml --depth-bits 16 --normals smooth
for other in '--image x.png' '--polygons x.csv' --explain --shares '--time-budget 100'; do
    # shellcheck disable=SC2086 # an option and its value
    usage_error "${other%% *}_shows_the_reference" "does not go with ${other%% *}" run pair.toml --precision float32 $other
done

# ---- the answer ----
# part KEY: a number of the JSON's emulation.
part() { value emulation | sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p"; }
# holds NAME EXPRESSION: an awk expression of the numbers below is true.
holds() {
    if awk -v sigma="$(value sigma_m2)" -v bound="$(value bound_m2)" -v ref="$(part reference_m2)" \
        -v ref_bound="$(part reference_bound_m2)" -v double="$(part sigma_double_m2)" \
        -v off="$(part off_m2)" -v sampling="$(part sampling_m2)" -v precision="$(part precision_m2)" \
        -v depth="$(part depth_m2)" -v exact="$exact" -v exact_bound="$exact_bound" \
        "function abs(x) { return x < 0 ? -x : x } BEGIN { exit !($2) }"; then
        ok "$1"
    else
        not_ok "$1" "$out"
    fi
}
run run pair.toml --direction 1,1,1 --method exact --json
exact=$(value sigma_m2)
exact_bound=$(value bound_m2)
plain=$(keys)
run run pair.toml --direction 1,1,1 --resolution 100 --precision float32 --depth-bits 16 --json
same without_a_tolerance_it_exits_0 "$rc" 0
same one_key_is_added "$(keys)" "$(printf %s "$plain" | sed 's/tolerance /tolerance emulation /')"
same it_says_what_was_emulated "$(part precision) $(part depth_bits) $(value resolution) $(value method)" '"float32" 16 100 "zbuffer"'
holds the_reference_is_method_exact 'ref == exact && ref_bound == exact_bound'
holds the_bound_reaches_the_reference_and_its_bound 'bound >= abs(sigma - ref) + ref_bound && bound <= 1.000001 * (abs(sigma - ref) + ref_bound)'
holds the_causes_add_up 'abs(sampling + precision + depth - off) <= 1e-12 * ref && abs(sigma - ref - off) <= 1e-12 * ref'
holds sampling_is_most_of_it 'off != 0 && abs(precision) < abs(sampling) && double - ref == sampling'
same there_is_no_guess_beside_it "$(value estimate_m2)" null
first=$(printf '%s\n' "$out" | grep -v '"seconds"\|"options"')
run run pair.toml --direction 1,1,1 --resolution 100 --method zbuffer --depth-bits 16 --precision=float32 --json
same the_method_may_be_named "$(printf '%s\n' "$out" | grep -v '"seconds"\|"options"')" "$first"

run run pair.toml --direction 1,1,1 --depth-bits 24 --json
same depth_alone_means_doubles_on_1024_pixels "$(part precision) $(part depth_bits) $(value resolution)" '"float64" 24 1024'
holds doubles_cost_nothing 'precision == 0'
run run pair.toml --direction 1,1,1 --precision float32 --json
same floats_alone_have_their_own_depth "$(part depth_bits)" 32
holds of_which_none_is_lost 'depth == 0 && precision != 0'

# The scene's rim is on pixels' edges, the shadow's rim too: no sampling error at all.
run run plates.toml --resolution 8 --precision float64 --json
holds a_scene_on_the_pixels_is_sampled_right 'abs(off) <= 1e-14 * ref'
run run plates.toml --resolution 7 --precision float64 --json
holds and_beside_them_is_not 'abs(off) > 1e-3 * ref'

# ---- tolerance, facets, table ----
run run plates.toml --resolution 7 --precision float32 --tolerance 1e-6 --json
same a_tolerance_that_is_missed_exits_3 "$rc $(value tolerance) $(printf '%s' "$out" | grep -c tolerance_not_met)" '3 {"asked": 9.9999999999999995e-07, "met": false, "accepted_by": null} 1'
run run plates.toml --resolution 8 --precision float32 --tolerance 1e-5
same one_that_is_met_does_not "$rc" 0
same the_table_splits_by_cause "$(printf '%s\n' "$out" | grep -cE '^  (all|sampling|precision|depth) +[-+][0-9.e+-]+ m2   [-+][0-9.e+-]+ of the reference')" 4
run run plates.toml --resolution 8 --precision float32 --facets -
same facets_have_the_area_of_their_pixels "$(printf '%s\n' "$out" | awk -F, 'NR > 1 { a += $5 } NR == 3 { low = a } END { printf "%.15g %.15g", low, a - low }')" "3 1"
run run ball.toml --tolerance 0.01 --resolution 64 --precision float32 --json
holds true_shapes_are_bounded_too 'bound >= abs(sigma - 7.24989628827)'
failure floats_do_not_hold_every_material "float32" run plates.toml --precision float32 --material 1e300,0,0.2,0
finish
