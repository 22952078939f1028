#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run: keys, exit codes, poses, files.
. "$(dirname "$0")/check.sh"

box_scene >"$scratch/box.toml"
pair_scene >"$scratch/pair.toml"
pair=$scratch/pair.toml

# ---- JSON ----
run run demo --tolerance 0.01 --json
same demo_runs "$((rc == 0 || rc == 3))" 1
same json_leaves_stderr_empty "$err" ""
same json_keys_in_order "$(keys)" "schema version scene_hash files unit sigma_m2 sigma_dbsm tolerance resolution normals estimate_m2 curvature_estimate_m2 notices sigma_glint_m2 sigma_diffuse_m2 bound_m2 budget_m2 material_uncertainty projected_area_m2 method method_reason effects flags facets direction seconds box_min_m box_max_m back_sides coarse_glint title materials options "
same budget_keys "$(value budget_m2 | grep -cE '^\{"visibility": [^,]+, "tessellation": [^,]+, "rounding": [^,]+\}$')" 1
same tolerance_keys "$(value tolerance | grep -cE '^\{"asked": 0\.01, "met": (true, "accepted_by": "bound"|false, "accepted_by": null)\}$')" 1
same facets_keys "$(value facets | grep -cE '^\{"total": [0-9]+, "front": [0-9]+, "hidden": [0-9]+, "partial": [0-9]+\}$')" 1
same seconds_keys "$(value seconds | grep -cE '^\{"load": [^,]+, "prepare": [^,]+, "pose": [^,]+\}$')" 1
same effects_are_eight "$(printf '%s\n' "$out" | grep -cE '^    \{"name": "[a-z_]+", "on": (true|false), "reason": ".+"\},?$')" 8
same hash_is_a_string_of_16_digits "$(value scene_hash | grep -cE '^"[0-9a-f]{16}"$')" 1
same default_direction_is_z "$(value direction)" "[0, 0, 1]"

run run "$scratch/box.toml" --json --material 0,0.25,0.2,0
same a_convex_box_needs_no_raster "$(value method) $(value resolution) $(value estimate_m2)" '"facet" null null'
same a_convex_box_exits_0 "$rc" 0
run run "$scratch/box.toml" --json --material 0,0,0.2,0
same no_return_is_exactly_zero "$(value sigma_m2) $(value sigma_dbsm) $(value bound_m2)" "0 null 0"
same zero_within_zero_is_met "$rc" 0

# ---- poses ----
# sigma_of ARGUMENTS...: sigma of the box.
sigma_of() {
    run run "$scratch/box.toml" --json --material 1,0.25,0.2,0.5 "$@"
    value sigma_m2
}
z=$(sigma_of)
x=$(sigma_of --direction 1,0,0)
same azel_0_90_is_exactly_z "$(sigma_of --azel 0,90)" "$z"
same equals_form_is_the_same "$(sigma_of --azel=0,90)" "$z"
same length_of_a_direction_does_not_matter "$(sigma_of --direction 0,0,8)" "$z"
same negative_numbers_are_values "$(sigma_of --direction -1,0,0)" "$x"
same negative_numbers_after_equals "$(sigma_of --direction=-2,0,0)" "$x"
same azel_negative_elevation "$(sigma_of --azel -90,-90)" "$z"
same an_elevation_beyond_90_goes_on_over_the_pole "$(sigma_of --azel 30,100)" "$(sigma_of --azel 210,80)"
same euler_identity "$(sigma_of --euler XYZ:0,0,0)" "$z"
same euler_quarter_turn "$(sigma_of --euler YXZ:-90,0,0)" "$x"
same quaternion_identity "$(sigma_of --quaternion 2,0,0,0)" "$z"
same blanks_in_a_list "$(sigma_of --direction ' 0, 0, 1')" "$z"
same seventeen_digits "$(printf '%s' "$x" | grep -cE '^[0-9.]{15,19}$')" 1

# ---- exit codes ----
run run "$pair" --tolerance 1e-12 --method zbuffer --resolution 16 --json
same tolerance_asked_and_not_met_exits_3 "$rc" 3
same and_says_why "$err" "lrcs: the tolerance 1e-12 is missed"
same tolerance_says_so "$(value tolerance | grep -c '"met": false')" 1
run run "$pair" --method zbuffer --resolution 16 --json
same forced_method_without_a_tolerance_exits_0 "$rc" 0

# ---- failures ----
failure missing_file "none.3ds: cannot open: No such file" run "$scratch/none.3ds"
failure folder_as_a_scene "Is a directory" run "$scratch"
: >"$scratch/empty.3ds"
failure empty_model "empty.3ds" run "$scratch/empty.3ds"
printf '\0\1\2\3' >"$scratch/data.bin"
failure binary_that_is_no_model "not a 3DS, OBJ or STL" run "$scratch/data.bin"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >"$scratch/bad.obj"
failure obj_index_out_of_range "bad.obj: line 4: face corner: found '9 with 3 in the file'" run "$scratch/bad.obj"
printf '[[part]]\nname = "a"\nshape = "ball"\n' >"$scratch/bad.toml"
failure scene_file_error_has_its_line "bad.toml: line 3: shape: found '\"ball\"', expected plate, disc" run "$scratch/bad.toml"
printf '[[part]]\nname = "a"\nfile = "gone.stl"\n' >"$scratch/lost.toml"
failure lost_model_names_scene_line_and_file "lost.toml: line 3: $scratch/gone.stl: cannot open: No such file or directory; looked for in the scene file's folder, $scratch/" run "$scratch/lost.toml"
printf 'hello\n' >"$scratch/junk.obj"
run run "$scratch/junk.obj"
same a_model_without_faces_is_told "$rc $(printf '%s\n' "$err" | sed -n 1p)" "0 notice: junk.obj: holds no facets: none of its lines is a face (f) as OBJ writes it"
printf '[[part]]\nname = "a"\nshape = "disc"\nradius = 1\nmaterial = "whte"\n' >"$scratch/near.toml"
failure a_material_of_the_library_is_suggested "found 'whte', expected the name of a [[material]] or of one of the library; the nearest in the library is paint-white" run "$scratch/near.toml"

# ---- files ----
cd "$scratch" || exit 1
"$tool" run "$pair" --facets f.csv --image i.png --image-size 64 >table.txt 2>notices.txt
facets=$("$tool" info "$pair" --json | sed -n 's/^  "facets": \([0-9]*\),/\1/p')
same csv_header "$(head -1 f.csv)" "facet,material,area_m2,cos_theta,visible_area_m2,sigma_m2"
same csv_has_a_row_for_every_facet "$(wc -l <f.csv | tr -d ' ')" "$((facets + 1))"
same csv_rows_are_numbered "$(sed 1d f.csv | cut -d, -f1 | awk '$1 != NR - 1' | wc -l | tr -d ' ')" 0
same csv_rows_have_six_fields "$(awk -F, 'NF != 6' f.csv | wc -l | tr -d ' ')" 0
same png_begins_like_one "$(od -An -tx1 -N8 i.png | tr -d ' ')" 89504e470d0a1a0a
same table_has_sigma "$(grep -c '^sigma ' table.txt)" 1
same notices_go_to_stderr "$(grep -c '^notice: ' table.txt)" 0
"$tool" run "$pair" --facets - 2>/dev/null | cmp -s - f.csv && ok csv_on_stdout_is_the_same || not_ok csv_on_stdout_is_the_same
run run "$pair" --facets "$scratch/no/f.csv"
same unwritable_facets_exit_1 "$rc" 1
same unwritable_facets_say_nothing_on_stdout "$out" ""
run run "$pair" --image "$scratch/no/i.png"
same unwritable_image_exits_1 "$rc" 1
run run "$pair" --image "$scratch"
same image_onto_a_folder_exits_1 "$rc" 1
printf old >kept.csv
run run "$scratch/none.3ds" --facets kept.csv
same a_failed_run_leaves_the_old_file "$(cat kept.csv)" old
same no_temporary_file_stays "$(find . -name '.lrcs*' | wc -l | tr -d ' ')" 0
if [ -e /dev/full ]; then
    for command in "run box.toml" "run box.toml --json" "info box.toml" "shape sphere --radius 1" "--help"; do
        # shellcheck disable=SC2086
        "$tool" $command >/dev/full 2>full.txt
        same "full_disk_exits_1_for_$(echo "$command" | tr -c 'a-z0-9\n' _)" "$?" 1
        same "full_disk_says_so_for_$(echo "$command" | tr -c 'a-z0-9\n' _)" "$(grep -c 'No space left' full.txt)" 1
    done
    run run "$pair" --facets /dev/full
    same full_disk_for_facets_exits_1 "$rc" 1
    same device_stays_a_device "$([ -c /dev/full ] && echo yes)" yes
fi

# ---- files by name ----
mkdir mats
printf 'mtllib lost\\Paint.MTL\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n' >mats/m.obj
printf 'newmtl red\nKd 1 0 0\n' >mats/paint.mtl
run info mats/m.obj --json
same mtl_is_found_beside_the_obj_in_any_case "$(printf '%s\n' "$out" | grep -c '"colour": "#FF0000"')" 1
rm mats/paint.mtl
run run mats/m.obj --json --material red=0,0.3,0.2,1
same names_bind_without_a_material_file "$(printf '%s\n' "$out" | grep -c "Paint.MTL' not found")" 1
printf 'newmtl red\nKd 0 1 0\n' >mats/m.mtl
run info mats/m.obj --json
same stem_mtl_is_the_fallback "$(printf '%s\n' "$out" | grep -c '"colour": "#00FF00"')" 1
same the_fallback_is_noticed "$(printf '%s\n' "$out" | grep -c "'m.mtl' is used instead")" 1
run run mats/m.obj --json --material '#00fF00=0,0.3,0.2,1'
same a_colour_binds "$rc" 0
printf '[[part]]\nname = "a"\nfile = "m.obj"\n' >mats/scene.toml
run info mats/scene.toml --json
same model_files_are_relative_to_the_scene_file "$(value facets)" 1
run info mats/m.obj --json --unit mm
same unit_scales_the_model "$(value area_m2)" 4.9999999999999998e-07

# ---- patience ----
printf '[[part]]\nname = "ball"\nshape = "sphere"\nradius = 1\nmaterial = "matt"\n[[material]]\nname = "matt"\nA = 0\nB = 0.3\ns = 0.2\nm = 1\n' >ball.toml
printf '[[part]]\nname = "tube"\nshape = "cylinder"\nradius = 0.5\nlength = 3\nmaterial = "matt"\n' | cat - ball.toml >pierced.toml
run run pierced.toml --tolerance 1e-5 --azel 20,30
same many_facets_are_announced "$(printf '%s\n' "$err" | grep -c '^notice: [0-9]* facets for a tolerance of 1e-05: .* takes a while$')" 1
run run ball.toml --tolerance 1e-1
same few_are_not "$(printf '%s\n' "$err" | grep -c 'takes a while')" 0

# ---- back sides, where no shadows are searched for ----
run run demo --azel 50,40 --method facet
same back_sides_that_others_may_hide_are_not_called_visible "$(printf '%s\n%s\n' "$out" "$err" | grep -c 'back sides')" 0

# ---- locale ----
for locale in de_DE.UTF-8 de_DE.utf8 fr_FR.UTF-8; do
    LC_ALL=$locale "$tool" run "$pair" --json --azel 10.5,20.5 | sed '/seconds/d' >there.txt
    LC_ALL=C "$tool" run "$pair" --json --azel 10.5,20.5 | sed '/seconds/d' >here.txt
    if cmp -s there.txt here.txt; then ok "locale_${locale}_changes_nothing"; else not_ok "locale_$locale"; fi
done
finish
