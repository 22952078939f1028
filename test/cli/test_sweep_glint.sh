#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep over curved parts that are too coarse for their glint: two columns say so in every row, as
# lrcs run says it of each pose, and every reader of rows knows them.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# A tube of 16 facets per turn, in one smoothing group, with a glint of 0.05: one facet at a time shines.
awk 'BEGIN {
    pi = atan2(0, -1)
    print "s 1"
    for (i = 0; i < 16; i++) { a = 2 * pi * i / 16; printf "v %.17g %.17g -1\nv %.17g %.17g 1\n", cos(a), sin(a), cos(a), sin(a) }
    for (i = 0; i < 16; i++) { a = 2 * i + 1; b = i == 15 ? 1 : a + 2; printf "f %d %d %d %d\n", a, b, b + 1, a + 1 }
}' >tube.obj
printf 'unit = "m"\n[[material]]\nname = "steel"\nA = 1\nB = 0.01\ns = 0.05\nm = 1\n[[part]]\nname = "tube"\nfile = "tube.obj"\nmaterial = "steel"\n' >tube.toml
sed 's/^s = 0.05/&\nA_error = 0.1/' tube.toml >vague.toml
sed 's/^s = 0.05/s = 0.4/' tube.toml >rough.toml
box_scene >box.toml
what="sweep tube.toml --az 0:45:2.25 --el 0"

# ---- the columns ----
run $what -o rows.csv
said=$err
same the_sweep_is_done "$rc" 0
same the_columns_stand_before_the_flags "$(sed -n 2p rows.csv)" "index,az_deg,el_deg,sigma_m2,sigma_dbsm,bound_m2,sigma_glint_m2,sigma_diffuse_m2,glint_error_estimate_m2,one_facet_dominates,flags"
index=0
for az in 0 2.25 4.5 6.75 9 11.25; do
    run run tube.toml --azel $az,0 --json
    want=$(value coarse_glint | sed 's/.*"error_estimate_m2": \([^,]*\), "one_facet_dominates": \(.*\)}/\1 \2/; s/true/1/; s/false/0/')
    same "row_${index}_is_what_run_reports" "$(awk -F, -v i=$index '$1 == i { print $9, $10 }' rows.csv)" "$want"
    index=$((index + 1))
done
# Along the normal of a side, two triangles of area 2 sin(pi/16) together, the glint is 4 pi A area, and
# as flat facets are wrong by more than that at worst, the error estimate is all of it. Between two sides there is no glint.
same along_a_normal_the_error_is_all_of_the_glint "$(awk -F, '$1 == 5 || $1 == 15 { d = $9 / (16 * atan2(0, -1) * sin(atan2(0, -1) / 16)) - 1; print d * d < 1e-20, $10 }' rows.csv | tr '\n' ' ')" "1 1 1 1 "
same between_normals_no_side_shines "$(awk -F, '$1 == 0 || $1 == 10 || $1 == 20 { print $9 < 1e-5, $10 }' rows.csv | tr '\n' ' ')" "1 0 1 0 1 0 "
dominated=$(awk -F, '/^[0-9]/ && $10 == 1' rows.csv | wc -l | tr -d ' ')
same the_last_lines_count_these_rows "$(printf '%s\n' "$said" | grep -c "^notice: in $dominated of 21 rows the glint of one flat face")" 1
for plain in box.toml rough.toml "tube.toml --normals smooth"; do
    # shellcheck disable=SC2086 # options are words
    run sweep $plain --az 0:45:9 --el 0
    same "no_such_columns_for_$plain" "$(printf '%s\n' "$out" | sed -n 2p | grep -c dominates)" 0
done

# ---- a slope that is varied: too coarse in some rows ----
run sweep rough.toml --vary steel.s:0.05:0.4:0.35 --az 11.25 --el 0 -o slopes.csv
same the_slope_of_the_row_decides "$(awk -F, '/^[0-9]/ { print ($10 > 1), $11 }' slopes.csv | tr '\n' ' ')" "1 1 0 0 "
run run tube.toml --material steel=1,0.01,0.05,1 --azel 11.25,0 --json
near as_run_finds_it_there "$(awk -F, '$1 == 0 { print $10 }' slopes.csv)" "$(value coarse_glint | sed 's/.*"error_estimate_m2": \([^,]*\),.*/\1/')"

# ---- every reader of rows ----
run $what --json
printf '%s\n' "$out" >rows.jsonl
same json_lines_have_them "$(sed -n 7p rows.jsonl | grep -c '"glint_error_estimate_m2": [0-9.]*, "one_facet_dominates": 1, "flags": \[\]}$')" 1
for k in 1 2; do
    "$tool" $what --shard $k/2 -o part.$k.csv 2>/dev/null
    "$tool" $what --shard $k/2 -o part.$k.jsonl 2>/dev/null
done
"$tool" merge part.1.csv part.2.csv -o merged.csv
same merged_rows_are_those_of_one_sweep "$(cmp rows.csv merged.csv && echo same)" same
"$tool" merge part.2.jsonl part.1.jsonl -o merged.jsonl
same so_are_json_lines "$(cmp rows.jsonl merged.jsonl && echo same)" same
head -9 rows.csv >again.csv.partial
run $what -o again.csv --resume
same a_resumed_sweep_is_the_same "$rc $(cmp rows.csv again.csv && echo same)" "0 same"
run $what -o map.npy
"$tool" merge part.1.csv part.2.csv -o merged.npy
same a_map_of_them_is_the_same "$(cmp map.npy merged.npy && cmp map.npy.head merged.npy.head && echo same)" same
for file in rows.csv rows.jsonl map.npy; do
    run plot $file -o drawn.svg
    same "${file}_is_drawn" "$rc $(grep -c '</svg>' drawn.svg)" "0 1"
done
# damaged FIELD VALUE TEXT: such a field in the sixth row is refused, and says what.
damaged() {
    awk -F, -v OFS=, -v f="$1" -v v="$2" 'NR == 8 { $f = v } { print }' rows.csv | head -9 >bad.csv.partial
    run $what -o bad.csv --resume
    same "damaged_field_$1_as_$2" "$rc $(printf '%s\n' "$err" | grep -c "line 8, $3")" "1 1"
    rm -f bad.csv.partial bad.csv.lock
}
damaged 9 -1 'glint_error_estimate_m2: found'
damaged 9 nan 'glint_error_estimate_m2: found'
damaged 9 1e9 'glint_error_estimate_m2: found .1e9., expected at most sigma_glint_m2'
damaged 10 0.5 'one_facet_dominates: found .0.5., expected 0 or 1'
damaged 10 '' 'one_facet_dominates: found'

# ---- beside the uncertainty of materials ----
run sweep vague.toml --az 0:45:2.25 --el 0 -o vague.csv
same both_groups_of_columns "$(sed -n 2p vague.csv | sed 's/.*sigma_diffuse_m2,//')" material_deviation_m2,material_low_m2,material_high_m2,material_sampled,glint_error_estimate_m2,one_facet_dominates,flags
same both_are_those_of_either "$(grep '^[0-9]' vague.csv | cut -d, -f1-8,13-)" "$(grep '^[0-9]' rows.csv)"
run plot vague.csv -o drawn.svg
same both_are_read "$rc" 0

# ---- peaks that are the normals of facets ----
run $what -o peaks.csv --brightest 9
same peaks_at_the_normals_of_sides_are_marked "$(printf '%s\n' "$out" | grep -c '^     note      the normal of a facet of a curved part')" 2
same and_no_other_peak_is_there "$(printf '%s\n' "$out" | awk '/^ +[0-9]+ / { print $2 }' | tr '\n' ' ')" "5 15 "
run sweep box.toml --az 0:90:15 --el 0 -o box.csv --brightest 3
same a_flat_body_shines_there_itself "$(printf '%s\n' "$out" | grep -c note)" 0
finish
