#!/bin/sh
# SPDX-License-Identifier: MIT
# What results were made from: every JSON has a schema and a version, and every file that a command writes
# names the files with their hashes, the version and the options, inside it or, where its format has no
# place for them, in FILE.json beside it.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
pair_scene >pair.toml
box_scene >box.toml
printf 'angle_deg,f_r\n0,1\n5,0.8\n10,0.5\n20,0.3\n30,0.25\n40,0.2\n50,0.19\n60,0.17\n' >data.csv

same the_hash_of_a_known_text "$(printf foobar >foobar && fnv1a foobar)" fnv1a:85944171f73967e8
pair=$(fnv1a pair.toml)
box=$(fnv1a box.toml)

# ---- what stands beside tables ----
# beside FILE INPUT HASH COMMAND...: FILE.json names the file and its input with their hashes.
beside() {
    file=$1 input=$2 hash=$3
    shift 3
    run "$@"
    same "${file}_is_written_with_what_it_was_made_from" "$(sed -n '2,5p; s/^    {"name": \(.*\), "hash": \("[^"]*"\).*/\1 \2/p' "$file.json")" \
"  \"lrcs\": \"$1\",
  \"schema\": 1,
  \"version\": \"$("$tool" --version | cut -c6-)\",
  \"file\": {\"name\": \"$file\", \"hash\": \"$(fnv1a "$file")\"},
\"$input\" \"$hash\""
    same "${file}_has_its_options" "$(grep -c "\"options\": \[.*=$file\"" "$file.json")" 1
}
beside settings.csv box.toml "$box" converge box.toml --seconds 0.05 --csv settings.csv
same the_settings_have_their_header_first "$(head -1 settings.csv | cut -d, -f1,2)" "setting,method"
beside facets.csv pair.toml "$pair" run pair.toml --azel 30,20 --facets facets.csv
same a_table_of_facets_has_its_header_first "$(head -1 facets.csv)" "facet,material,area_m2,cos_theta,visible_area_m2,sigma_m2"
run run pair.toml --azel 30,20 --json
for key in scene_hash unit direction; do
    same "beside_it_is_the_${key}_of_the_run" "$(sed -n "s/^  \"$key\": \(.*\),$/\1/p" facets.csv.json)" "$(value $key)"
done
same beside_it_are_the_materials "$(grep -c '"name": "paint-white".*"source": "illustrative"' facets.csv.json)" 1
beside polygons.csv pair.toml "$pair" run pair.toml --azel 30,20 --polygons polygons.csv
beside body.vtk pair.toml "$pair" image pair.toml --azel 30,20 --vtk body.vtk
beside body.vtp pair.toml "$pair" image pair.toml --azel 30,20 --vtk body.vtp
beside fitted.csv data.csv "$(fnv1a data.csv)" fit data.csv --csv fitted.csv
mkdir empty
cd empty || exit 1
run run ../pair.toml --facets - >/dev/null
run run ../pair.toml --facets /dev/null
same nothing_stands_beside_standard_output_or_a_device "$(ls)" ""
cd .. || exit 1

usage_error a_table_has_no_name_that_the_other_needs "t.csv.json is the file that names what 't.csv' was made from" run pair.toml --polygons t.csv --facets t.csv.json

# ---- what stands inside ----
# inside FILE INPUT HASH: the file holds the version and both.
inside() {
    same "$1_holds_what_it_was_made_from" "$(LC_ALL=C tr -d '\0' <"$1" | LC_ALL=C grep -a -c "lrcs $("$tool" --version | cut -c6-).*$2 $3")" 1
}
"$tool" run pair.toml --image seen.png >/dev/null 2>&1
inside seen.png pair.toml "$pair"
"$tool" image pair.toml -o image.png --visible visible.svg 2>/dev/null
inside image.png pair.toml "$pair"
inside visible.svg pair.toml "$pair"
"$tool" profile pair.toml --bin 0.1 --csv bins.csv --plot bins.svg >/dev/null 2>&1
inside bins.csv pair.toml "$pair"
inside bins.svg pair.toml "$pair"
same a_table_has_its_options "$(head -1 bins.csv | grep -c "; options=--bin=0.1;")" 1
"$tool" converge box.toml --seconds 0.05 --csv settings.csv --plot cost.svg --plot cost.png >/dev/null 2>&1
for file in cost.svg cost.png; do
    inside $file box.toml "$box"
done
"$tool" fit data.csv --plot fit.svg --residuals left.png >/dev/null 2>&1
inside fit.svg data.csv "$(fnv1a data.csv)"
inside left.png data.csv "$(fnv1a data.csv)"
"$tool" sweep pair.toml --az 0:90:30 --el 0 -o rows.csv --plot rows.svg --stats-file stats.csv --stats-file stats.svg --stats-file stats.png >/dev/null 2>&1
for file in rows.csv rows.svg stats.csv stats.svg stats.png; do
    inside $file pair.toml "$pair"
done
same drawings_of_a_sweep_name_its_scene_by_hash "$(grep -l "scene_hash=$(sed -n '1s/.*scene_hash=\([0-9a-f]*\).*/\1/p' rows.csv)" rows.svg stats.svg | wc -l | tr -d ' ')" 2

# ---- units ----
printf 'v 0 0 0\nv 2000 0 0\nv 0 2000 0\nmtllib plate.mtl\nusemtl skin\nf 1 2 3\n' >plate.obj
printf 'newmtl skin\nKd 1 0 0\n' >plate.mtl
cp plate.obj other.obj
# units: of every file of the JSON in $out, by name, and of the scene.
units() { printf '%s\n' "$out" | sed -n 's/^    {"name": "\([^"]*\)", "hash": "[^"]*", "unit": \(.*\)},*$/\1=\2/p' | LC_ALL=C sort | tr '\n' ' '; value unit; }
for command in 'run' 'info' 'profile --bin 100' 'converge --seconds 0.02'; do
    # shellcheck disable=SC2086 # a command and its options
    set -- $command
    name=$1
    shift
    run "$name" plate.obj "$@" --json
    same "${name}_states_what_was_assumed" "$(units)" 'plate.mtl=null plate.obj="m assumed" null'
    run "$name" plate.obj "$@" --json --unit mm
    same "${name}_states_the_unit_given" "$(units)" 'plate.mtl=null plate.obj="mm" "mm"'
done
run run plate.obj --unit 0.001 --json
same a_known_unit_has_its_name "$(units)" 'plate.mtl=null plate.obj="mm" "0.001"'
printf 'unit = "ft"\n[[part]]\nname = "a"\nfile = "plate.obj"\nunit = "mm"\n[[part]]\nname = "b"\nfile = "other.obj"\ntranslate = [0, 0, 5]\n[[part]]\nname = "c"\nfile = "plate.obj"\nunit = 0.5\n[[part]]\nname = "d"\nshape = "box"\nsize = [1, 1, 1]\n' >units.toml
run run units.toml --json
same every_part_of_a_scene_has_its_own "$(units)" 'other.obj="ft" plate.mtl=null plate.mtl=null plate.mtl=null plate.obj="0.5" plate.obj="mm" units.toml="m" "m"'
printf '[[part]]\nname = "a"\nfile = "plate.obj"\n' >silent.toml
run run silent.toml --json
same a_scene_file_that_states_none_says_so "$(units)" 'plate.mtl=null plate.obj="m assumed" silent.toml="m" "m"'
run run demo --json
same the_built_in_scene_is_in_metres "$(units)" '"m"'
"$tool" sweep units.toml --az 0:20:10 --el 0 -o units.csv 2>/dev/null
same the_first_line_of_a_sweep_names_them "$(head -1 units.csv | grep -o 'fnv1a:[0-9a-f]* unit=[a-z0-9.]*' | sed 's/.*=//' | LC_ALL=C sort | tr '\n' ' ')" "0.5 ft m mm "
"$tool" profile plate.obj --unit in --bin 10 --csv inches.csv --plot inches.svg >/dev/null 2>&1
same and_that_of_a_profile "$(head -1 inches.csv | grep -c 'file=plate.obj fnv1a:[0-9a-f]* unit=in;')" 1
same and_its_chart "$(grep -c 'file=plate.obj fnv1a:[0-9a-f]* unit=in;' inches.svg)" 1
run plot units.csv -o again.svg
same a_table_that_names_them_is_drawn_again "$rc" 0
run sweep units.toml --az 0:20:10 --el 0 --shard 1/2 -o first.csv
run sweep units.toml --az 0:20:10 --el 0 --shard 2/2 -o second.csv
run merge first.csv second.csv -o merged.csv
same shards_that_name_them_are_merged "$rc $(cmp merged.csv units.csv && echo same)" "0 same"

# ---- every JSON ----
# stated NAME ARGUMENTS...: its first keys are the schema and the version.
stated() {
    name=$1
    shift
    run "$@"
    same "json_of_${name}_has_schema_and_version" "$(printf '%s\n' "$out" | grep -E '^ *"(schema|version)":' | head -2 | tr -d ' \n')" "\"schema\":1,\"version\":\"$("$tool" --version | cut -c6-)\","
}
stated run run pair.toml --json
same json_of_run_names_its_file "$(printf '%s\n' "$out" | grep -c "\"pair.toml\", \"hash\": \"$pair\", \"unit\": \"m\"")" 1
stated info info pair.toml --json
same json_of_info_names_its_file "$(printf '%s\n' "$out" | grep -c "\"pair.toml\", \"hash\": \"$pair\"")" 1
stated shape shape sphere --radius 1 --json
stated fit fit data.csv --json
same json_of_fit_names_its_file "$(printf '%s\n' "$out" | grep -c "\"data.csv\", \"hash\": \"$(fnv1a data.csv)\"")" 1
stated profile profile pair.toml --bin 0.1 --json
stated converge converge box.toml --seconds 0.05 --json
same json_of_converge_names_its_file "$(printf '%s\n' "$out" | grep -c "\"box.toml\", \"hash\": \"$box\"")" 1
finish
