#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs converge: which truth it takes, its columns, its conclusion, files, exit codes. No time is tested.
. "$(dirname "$0")/check.sh"
examples=$root/examples
cd "$scratch" || exit 1

# column NAME: a column of the CSV t.csv, its rows of some settings (a pattern).
column() {
    awk -F, -v name="$1" -v rows="${2:-.}" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) k = i }
        NR > 1 && $1 ~ rows { print $k }' t.csv
}
# truth KEY: of the JSON in $out.
truth() { value truth | sed "s/.*\"$1\": \([^,}]*\)[,}].*/\1/"; }
# within NAME BOUND: every error in t.csv that has a bound lies within that plus the truth's own BOUND.
within() {
    same "$1" "$(awk -F, -v own="$2" 'NR > 1 && $11 != "" { n++; if (!($10 <= $11 + own)) bad++ }
        END { print (n > 0), bad + 0 }' t.csv)" "1 0"
}

# ---- a scene of flat faces, in the open: the truth is the closed form ----
run converge "$examples/plate.toml" --azel 0,70 --seconds 1 --csv t.csv --plot p.svg --plot p.PNG
same plate_exits_0 "$rc" 0
same csv_columns "$(head -1 t.csv)" "setting,method,resolution,mesh_tolerance,facets,repetitions,prepare_ms,pose_ms,sigma_m2,error_m2,bound_m2,estimate_m2,relative_error,relative_bound,relative_estimate,accepted_by"
same rows_have_all_columns "$(awk -F, 'NF != 16' t.csv | wc -l | tr -d ' ')" 0
same facet_rasters_and_exact_are_tried "$(column setting | sed -n '1,3p;$p' | tr '\n' ' ')" "facet zbuffer 16 zbuffer 32 exact "
same flat_faces_have_no_mesh_tolerance "$(column mesh_tolerance | sort -u)" ""
near spot_value_of_the_plate "$(column sigma_m2 exact)" 3.27656091132
within plate_errors_are_within_their_bounds 1e-14
same table_ends_with_the_sentence "$(printf '%s\n' "$out" | tail -1 | grep -cE '^The cheapest setting by pose time for a proved bound of 1e-2.*1e-3.*1e-4.*1e-6.*; the best bound, [^ ]+ of sigma, is that of .*\.$')" 1
same table_names_its_truth "$(printf '%s\n' "$out" | grep -c '^truth .*: the closed form of the plate$')" 1
same table_has_a_line_for_every_row "$(printf '%s\n' "$out" | grep -cE '^(facet|exact|zbuffer) ')" "$(sed 1d t.csv | wc -l | tr -d ' ')"
same svg_is_one "$(sed -n 2p p.svg | cut -c1-4)" "<svg"
same png_is_one "$(od -An -tx1 -N8 p.PNG | tr -d ' ')" 89504e470d0a1a0a

# ---- a curved shape: the closed form shows what the mesh costs ----
run converge "$examples/cylinder.toml" --azel 0,30 --seconds 1e-9 --csv t.csv --json
near truth_of_the_cylinder_is_the_closed_form "$(truth sigma_m2)" 3.59042673334
same truth_of_a_shape_is_not_of_its_facets "$(truth of_facets)" false
same meshes_get_finer "$(column facets mesh | sort -cn && column facets mesh | sort -u | wc -l | tr -d ' ')" 5
same meshes_are_named_by_their_tolerance "$(column mesh_tolerance mesh | tr '\n' ' ')" "1e-1 1e-3 1e-4 1e-5 1e-6 "
same the_coarsest_mesh_has_the_largest_error_the_finest_the_smallest \
    "$(column error_m2 mesh | sort -rg | sed -n '1p;$p' | tr '\n' ' ')" "$(column error_m2 mesh | sed -n '1p;$p' | tr '\n' ' ')"
same a_mesh_for_a_tolerance_meets_it "$(awk -F, 'NR > 1 && $14 > $4' t.csv | wc -l | tr -d ' ')" 0
within cylinder_errors_are_within_their_bounds 1e-13
same json_keys_in_order "$(keys)" "schema version scene_hash files unit direction truth settings cheapest best notices sentence title materials options "
same json_has_every_setting "$(printf '%s\n' "$out" | grep -c '^    {"setting": ')" "$(sed 1d t.csv | wc -l | tr -d ' ')"
same json_has_four_tolerances "$(printf '%s\n' "$out" | grep -cE '^    \{"tolerance": [0-9.e-]+, "setting": "')" 4
same json_says_what_time_left_out "$(printf '%s\n' "$out" | grep -c '"left out: zbuffer 16 and finer, for time"')" 1
run shape cylinder --radius 0.5 --length 2 --aspect 60 --material 1,0.25,0.2,0.5 --json
same example_files_are_what_they_say "$(value sigma_m2 | cut -c1-12)" 3.5904267333

same what_is_proved_needs_no_estimate "$(column setting estimate)" ""

# ---- what an estimate costs, beside what a proof costs ----
pair_scene >two.toml
run converge two.toml --direction 1,2,5 --seconds 0.2 --csv t.csv --plot two.svg
same previews_are_three_rows "$(column setting estimate | tr '\n' ',')" "by estimate 1e-1,by estimate 1e-2,by estimate 1e-3,"
same what_is_accepted_is_told "$(column accepted_by estimate | grep -cvE '^(estimate|bound)$') $(column accepted_by '^(facet|exact|zbuffer)' | sort -u)" "0 "
same and_is_within_its_tolerance_by_what_accepts_it "$(awk -F, '/^by estimate/ { split($1, w, " "); tol = w[3] + 0
    if ($16 == "estimate" ? !($15 <= tol && $14 > tol) : !($14 <= tol)) bad++ } END { print bad + 0 }' t.csv)" 0
same the_sentence_ends_with_what_they_cost "$(printf '%s\n' "$out" | tail -1 | grep -cE 'Accepted by estimate, a tolerance of 1e-1 takes [^ ]+ ms.*, 1e-2 takes [^ ]+ ms.*, 1e-3 takes [^ ]+ ms.*\.$')" 1
same the_plot_has_a_curve_of_them "$(grep -c 'accepted by estimate: error' two.svg)" 1
run converge two.toml --direction 1,2,5 --seconds 0.2 --json
same json_has_their_tolerances "$(printf '%s\n' "$out" | grep -cE '"setting": "by estimate .*"tolerance": [0-9.]+, "accepted_by": "(estimate|bound)"')" 3

# ---- a shape that is turned: exact is the truth, and agrees with the closed form ----
cat >turned.toml <<'END'
[[part]]
name = "box"
shape = "box"
size = [1, 2, 3]
rotate_axis = [1, 0, 0]
rotate_deg = 90
END
run converge turned.toml --direction 1,2,3 --seconds 0.05 --csv t.csv --json
exact=$(truth sigma_m2)
same turned_shape_has_exact_for_its_truth "$(truth from | cut -c1-6)" '"exact'
within turned_errors_are_within_their_bounds 1e-13
run shape box --size 1,2,3 --direction 1,3,-2 --material 1,0.25,0.2,0.5 --json
near exact_truth_agrees_with_the_closed_form "$exact" "$(value sigma_m2)"

# ---- shapes that shadow each other: their meshes' bounds are not against the truth ----
cat >pair.toml <<'END'
[[part]]
name = "ball"
shape = "sphere"
radius = 0.5
material = "paint-white"
[[part]]
name = "box"
shape = "box"
size = [3, 1, 1]
translate = [0.3, 0.2, -4]
material = "solar-cell"
END
run converge pair.toml --azel 20,70 --seconds 0.3 --csv t.csv --json
same truth_of_a_scene_is_of_its_true_shapes "$(truth of_facets)" false
same coarser_meshes_have_errors_and_bounds "$(column error_m2 mesh | grep -c .) $(column bound_m2 mesh | grep -c .)" "$(column setting mesh | wc -l | tr -d ' ') $(column setting mesh | wc -l | tr -d ' ')"
same the_truth_does_not_judge_its_own_mesh "$(column mesh_tolerance mesh | grep -cx "$(column mesh_tolerance '^exact$')")" 0
same exact_has_no_error_against_itself "$(column error_m2 '^exact$')" 0
within pair_errors_are_within_their_bounds "$(truth bound_m2)"
sed 's/^radius = 0.5$/&\nscale = [1, 1, 0.8]/' pair.toml >uneven.toml
run converge uneven.toml --azel 20,70 --seconds 0.3 --csv t.csv --json
same an_unevenly_scaled_shape_is_known_beyond_its_facets "$(truth of_facets)" false
same its_coarser_meshes_have_errors_and_bounds "$(column error_m2 mesh | grep -c .) $(column bound_m2 mesh | grep -c .)" "$(column setting mesh | wc -l | tr -d ' ') $(column setting mesh | wc -l | tr -d ' ')"

# ---- nothing comes back: sigma is 0 and so are all errors ----
run converge "$examples/plate.toml" --azel 0,-70 --seconds 0.05 --csv t.csv --plot zero.svg
same zero_sigma_exits_0 "$rc" 0
same zero_sigma_has_no_error "$(column error_m2 | sort -u) $(column bound_m2 | sort -u)" "0 0"
same zero_sigma_is_in_m2 "$(printf '%s\n' "$out" | tail -1 | grep -c 'the best bound, 0 m2, is that of')" 1

# ---- files ----
run converge "$examples/plate.toml" --seconds 0.05 --csv -
same csv_instead_of_the_table "$(printf '%s\n' "$out" | head -1 | cut -c1-15)" "setting,method,"
run converge "$examples/plate.toml" --seconds 0.05 --plot no/p.svg
same unwritable_plot_exits_1 "$rc" 1
same unwritable_plot_says_nothing_on_stdout "$out" ""
run converge none.3ds --csv kept.csv
same missing_scene_exits_1 "$rc" 1
same no_file_of_a_failed_run "$(ls kept.csv 2>/dev/null)" ""
same no_temporary_file_stays "$(find . -name '.lrcs*' | wc -l | tr -d ' ')" 0
if [ -e /dev/full ]; then
    run converge "$examples/plate.toml" --seconds 0.05 --csv /dev/full
    same full_disk_exits_1 "$rc" 1
fi

# ---- usage ----
usage_error plot_of_another_kind "expected FILE.svg or FILE.png, found 'p.pdf'" converge demo --plot p.pdf
usage_error plot_without_an_extension "found 'svg'" converge demo --plot svg
usage_error plot_that_is_all_extension "found '.svg'" converge demo --plot .svg
usage_error plot_to_stdout "found '-'" converge demo --plot -
usage_error one_plot_twice "--plot and --plot name the same file" converge demo --plot a.svg --plot ./a.svg
usage_error csv_and_plot_in_one_file "--csv and --plot name the same file" converge demo --csv a.svg --plot a.svg
cp turned.toml scene.svg
usage_error plot_over_the_scene "--plot scene.svg: would overwrite scene.svg" converge scene.svg --plot scene.svg
usage_error csv_over_the_scene "--csv ./turned.toml: would overwrite turned.toml" converge turned.toml --csv ./turned.toml
usage_error csv_and_json_on_stdout "both want standard output" converge demo --csv - --json
usage_error no_time "found '0'" converge demo --seconds 0
usage_error time_that_is_no_number "found 'soon'" converge demo --seconds soon
usage_error converge_knows_no_method "unknown option '--method'" converge demo --method exact
usage_error converge_without_a_scene "SCENE is missing" converge
usage_error unit_of_a_scene_file "its own units" converge demo --unit mm
usage_error material_that_no_facet_has "the nearest is 'foil'" converge demo --material fool=1,0.2,0.3,1
finish
