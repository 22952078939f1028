#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run --polygons: the table, the options that it can be combined with, and its areas against those
# of --facets.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
plates_scene >pair.toml

run run pair.toml --method exact --polygons rings.csv --facets facets.csv
same polygons_are_written "$rc" 0
same polygons_have_a_header "$(head -1 rings.csv)" "facet,ring,x_m,y_m,z_m,u_m,v_m"
same rows_are_seven_numbers "$(sed 1d rings.csv | grep -cvE '^([0-9]+,){2}(-?[0-9.e+-]+,){4}-?[0-9.e+-]+$')" 0
same rings_count_from_0 "$(sed -n '2s/^[0-9]*,\([0-9]*\),.*/\1/p' rings.csv)" 0
same points_of_the_low_plate_lie_in_it "$(awk -F, '$1 < 2 && NR > 1 && $5 != 0' rings.csv | wc -l | tr -d ' ')" 0
same from_z_the_view_is_x_and_y "$(awk -F, 'NR > 1 && ($3 != $6 || $4 != $7)' rings.csv | wc -l | tr -d ' ')" 0
same a_whole_facet_has_three_points "$(grep -c '^2,' rings.csv) $(grep -c '^3,' rings.csv)" "3 3"

# areas FILE: each facet's area by its rings (fans about each ring's first point).
areas() {
    awk -F, 'BEGIN { ring = -1 } NR > 1 {
        if ($2 != ring) { ring = $2; n = 0; x0 = $6; y0 = $7 }
        if (n++ > 1) area[$1] += ((x - x0) * ($7 - y0) - (y - y0) * ($6 - x0)) / 2
        x = $6; y = $7
    } END { for (f = 0; f < 4; f++) printf "%.12f ", area[f] }' "$1"
}
told=$(awk -F, 'NR > 1 { printf "%.12f ", $5 }' facets.csv)
same rings_have_the_areas_told "$(areas rings.csv)" "$told"
same the_low_plate_shows_three_quarters "$(printf '%s' "$told" | awk '{ printf "%.9f", $1 + $2 }')" 3.000000000

run run pair.toml --polygons -
same a_dash_stands_in_place_of_the_table "$rc $out" "0 $(cat rings.csv)"
run run pair.toml --polygons rings2.csv --resolution 64 --tolerance 0.5
same under_auto_polygons_are_exact_whatever_the_method "$(cat rings2.csv)" "$(cat rings.csv)"
run run demo --polygons demo.csv --json
same json_and_a_file_of_polygons "$rc $(printf '%s' "$out" | head -1)" "0 {"

usage_error not_with_the_raster "--polygons: visible polygons come from --method exact (or auto), found --method zbuffer" \
    run demo --polygons p.csv --method zbuffer
usage_error not_without_visibility "--method facet" run demo --polygons p.csv --method facet
usage_error not_twice_to_stdout "--facets and --polygons name the same file" run demo --facets - --polygons -
usage_error not_beside_json_on_stdout "--polygons - and --json both want standard output" run demo --polygons - --json
usage_error not_over_the_facets "name the same file" run demo --facets p.csv --polygons ./p.csv
usage_error not_over_the_picture "name the same file" run demo --image p.csv --polygons p.csv
usage_error not_over_the_scene "--polygons pair.toml: would overwrite pair.toml" run pair.toml --polygons pair.toml
same nothing_was_written "$(ls p.csv 2>/dev/null)" ""
failure a_folder_that_is_not_there "none/p.csv" run demo --polygons none/p.csv
finish
