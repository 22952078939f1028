#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep: which rows there are and what stands in them.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

box_scene >box.toml
pair_scene >pair.toml

# sweep ARGUMENTS...: the rows alone.
sweep() { "$tool" sweep "$@" 2>/dev/null | grep -v '^#' | sed 1d; }
# column NUMBER: of the rows on stdin.
column() { cut -d, -f"$1"; }
# alike NAME COMMAND_A COMMAND_B: the same bytes.
alike() {
    eval "$2" >a.out
    eval "$3" >b.out
    if [ -s a.out ] && cmp -s a.out b.out; then ok "$1"; else not_ok "$1" "$(diff a.out b.out | head -4)"; fi
}

# ---- rows ----
run sweep pair.toml --az 0:30:10 --el 0
same a_cut_exits_0 "$rc" 0
same the_first_line_says_what_it_is "$(printf '%s\n' "$out" | head -1)" \
    "# lrcs $("$tool" --version | cut -d' ' -f2) sweep; scene_hash=$("$tool" run pair.toml --json 2>/dev/null | sed -n 's/.*"scene_hash": "\(.*\)",/\1/p'); rows=4; shape=4; az=0:30:10; el=0; tolerance=0.0001; method=auto; resolution=auto; normals=flat; title=pair.toml; materials=illustrative or assumed; files=pair.toml $("$tool" run pair.toml --json 2>/dev/null | sed -n 's/.*"hash": "\(fnv1a:[0-9a-f]*\)".*/\1/p') unit=m"
same the_second_line_names_columns "$(printf '%s\n' "$out" | sed -n 2p)" "index,az_deg,el_deg,sigma_m2,sigma_dbsm,bound_m2,sigma_glint_m2,sigma_diffuse_m2,flags"
same both_ends_are_in "$(printf '%s\n' "$out" | sed '1,2d;$d' | column 2 | tr '\n' ' ')" "0 10 20 30 "

for axis in 10 20; do
    run run pair.toml --azel $axis,0 --json
    same "row_of_${axis}_deg_is_what_run_says" \
        "$(sweep pair.toml --az 0:30:10 | grep ",$axis,0," | column 4-8)" \
        "$(value sigma_m2),$(value sigma_dbsm),$(value bound_m2),$(value sigma_glint_m2),$(value sigma_diffuse_m2)"
done
run run pair.toml --euler XZY:10,20,30 --json
same an_euler_row_is_what_run_says "$(sweep pair.toml --euler XZY:10,0:20:20,30 | tail -1 | column 5)" "$(value sigma_m2)"

# The double of 3 x 0.1 is not that of 0.3: steps are counted, not added.
same steps_do_not_drift "$(sweep box.toml --az 0:0.7:0.1 | column 2 | tr '\n' ' ')" \
    "0 0.10000000000000001 0.20000000000000001 0.29999999999999999 0.40000000000000002 0.5 0.59999999999999998 0.69999999999999996 "
same steps_down "$(sweep box.toml --el 90:-90:-45 | column 2 | tr '\n' ' ')" "90 45 0 -45 -90 "
same an_end_that_is_not_met_is_out "$(sweep box.toml --az -1:1:0.75 | column 2 | tr '\n' ' ')" "-1 -0.25 0.5 "
same exponents_in_a_range "$(sweep box.toml --az 1e-1:3e-1:1e-1 | column 2 | tail -1)" 0.29999999999999999
same the_axis_given_last_is_fastest "$(sweep box.toml --el 0:1:1 --az 0:1:1 | column 1,2,3 | tr '\n' ' ')" "0,0,0 1,0,1 2,1,0 3,1,1 "

# ---- threads ----
for jobs in 2 3 7; do
    alike "the_same_bytes_with_${jobs}_threads" '"$tool" sweep demo --tolerance 1e-2 --az 0:340:20 --el -60:60:60 --jobs 1 2>/dev/null' \
        "\"\$tool\" sweep demo --tolerance 1e-2 --az 0:340:20 --el -60:60:60 --jobs $jobs 2>/dev/null"
done

# ---- turning ----
# v_obs = R v_body: a turn of the body about x is the first Euler angle of XYZ.
alike rotate_about_x_is_an_euler_angle 'sweep pair.toml --rotate x:0:90:30 | column 3,5' 'sweep pair.toml --euler XYZ:0:90:30,0,0 | column 5,7'
alike rotate_about_a_vector 'sweep pair.toml --rotate 0,0,2:0:90:30 --azel 10,20 | column 3' 'sweep pair.toml --rotate z:0:90:30 --azel 10,20 | column 3'
alike an_elevation_beyond_90_goes_on_over_the_pole 'sweep box.toml --az 30 --el 100 | column 4' 'sweep box.toml --az 210 --el 80 | column 4'
# The laser at azimuth 0, the body turned by +30 deg about z: the body sees it at azimuth -30.
alike a_turn_about_z_moves_the_laser_back 'sweep box.toml --rotate z:30 --azel 0,0 | column 3 | cut -c1-12' 'sweep box.toml --az -30 --el 0 | column 4 | cut -c1-12'

# ---- all directions ----
# The mean over all directions of a convex body of one material: S (pi A E + 2 pi B / (m + 3)),
# E = s^2 + sqrt(pi)/2 s^3 erfcx(1/s). Here S = 22, A = 0, B = 0.25, m = 0: 22 * 2 pi * 0.25 / 3.
run sweep box.toml --sphere 2000 --material 0,0.25,0.2,0
mean=$(printf '%s\n' "$out" | sed -n 's/^# mean_sigma_m2=\([^;]*\);.*/\1/p')
same the_mean_is_within_a_thousandth "$(awk -v a="$mean" 'BEGIN { b = 22 * 2 * 3.14159265358979 * 0.25 / 3; d = a / b - 1; print (a != "" && d * d < 1e-6) }')" 1
same the_mean_is_that_of_the_rows "$(printf '%s\n' "$out" | grep -v '^#' | sed 1d | awk -F, -v m="$mean" '{ s += $5; q += $5 * $5 } END { d = s / NR / m - 1; print NR, (d * d < 1e-24) }')" "2000 1"
same so_is_its_standard_error "$(printf '%s\n' "$out" | awk -F, '/^[0-9]/ { n++; s += $5; q += $5 * $5 } /^# mean/ { split($0, w, /[=;]/); d = sqrt((q - s * s / n) / (n - 1) / n) / w[4] - 1; print (d * d < 1e-16) }')" 1
same directions_are_unit_vectors "$(printf '%s\n' "$out" | awk -F, '/^[0-9]/ { d = $2 * $2 + $3 * $3 + $4 * $4 - 1; if (d * d > 1e-28) bad++ } END { print bad + 0 }')" 0
# Near-uniform: of 2000 points the share in each octant is an eighth, and no two are near each other
# (their mean distance apart is sqrt(4 pi / N) = 0.079).
same octants_hold_an_eighth_each "$(printf '%s\n' "$out" | awk -F, '/^[0-9]/ { k = ($2 > 0) + 2 * ($3 > 0) + 4 * ($4 > 0); c[k]++ } END { for (k = 0; k < 8; k++) if (c[k] < 245 || c[k] > 255) bad++; print bad + 0 }')" 0
same no_two_directions_are_near "$(printf '%s\n' "$out" | awk -F, '/^[0-9]/ { x[n] = $2; y[n] = $3; z[n++] = $4 } END { for (i = 0; i < n; i++) for (j = i + 1; j < n && z[i] - z[j] < 0.05; j++) { d = (x[i]-x[j])^2 + (y[i]-y[j])^2 + (z[i]-z[j])^2; if (d < 0.05^2) bad++ } print bad + 0 }')" 0
run sweep box.toml --sphere 1
same one_direction_has_no_standard_error "$(printf '%s\n' "$out" | grep -c '^# mean.*standard_error_m2=;')" 1
same and_nobody_reads_nan "$(printf '%s\n' "$out$err" | grep -ci nan) $(printf '%s\n' "$err" | grep -c 'standard error not known from one direction')" "0 1"

# ---- attitudes from a file ----
printf '# a track\ntime,w,x,y,z\n0,1,0,0,0\n0.5,2,0,0,0\n\n1,0.70710678118654752,0.70710678118654752,0,0\r\n' >q.csv
printf 't,qx,qy,qz,qw,mode\n0,0,0,0,1,nadir\n0.5,0,0,0,2,nadir\n1,0.70710678118654752,0,0,0.70710678118654752,sun\n' >last.csv
printf '0,0,0,1\n0.5,0,0,4\n1,0,1,0\n' >d.csv
same a_track_has_times "$(sweep pair.toml --poses q.csv | column 2 | tr '\n' ' ')" "0 0.5 1 "
run sweep pair.toml --poses last.csv
same a_column_of_a_track_that_is_not_used_is_told "$(printf '%s\n' "$err" | grep -c "^notice: last.csv: column 'mode' is not used")" 1
alike quaternions_by_name 'sweep pair.toml --poses q.csv' 'sweep pair.toml --poses last.csv'
same a_quarter_turn_about_x_shows_y "$(sweep pair.toml --poses q.csv | column 3,4,5 | sed -n 1p) $(sweep pair.toml --poses q.csv | column 4 | sed -n 3p | cut -c1-6)" "0,0,1 1"
run run pair.toml --quaternion 0.70710678118654752,0.70710678118654752,0,0 --json
same a_row_of_a_track_is_what_run_says "$(sweep pair.toml --poses q.csv | tail -1 | column 6)" "$(value sigma_m2)"
run run pair.toml --direction 0,1,0 --json
same a_track_of_directions "$(sweep pair.toml --poses d.csv | tail -1 | column 2,3,4,5,6)" "1,0,1,0,$(value sigma_m2)"
printf 'time,w,x,y,z\n0,1,0,0,0\n1,1,0,zero,0\n' >bad.csv
failure a_bad_row_has_its_line "bad.csv: line 3, column y: found 'zero', expected a finite number" sweep pair.toml --poses bad.csv
printf '0,1,0,0,0\n1,0,0,0,0\n' >bad.csv
failure a_quaternion_of_zero "line 2: expected a quaternion or direction that is not zero" sweep pair.toml --poses bad.csv
printf '0,1,0,0,0\n1,1,0,0\n' >bad.csv
failure a_row_too_short "line 2: found 4 fields, expected 5 as in the first line" sweep pair.toml --poses bad.csv
printf 'time,w,x,y\n0,1,0,0\n' >bad.csv
failure a_column_missing "expected columns time,w,x,y,z" sweep pair.toml --poses bad.csv
printf 'time,w,x,y,z,qx\n0,1,0,0,0,0\n' >bad.csv
failure a_column_twice "two columns are the same" sweep pair.toml --poses bad.csv
: >bad.csv
failure an_empty_track "no attitude" sweep pair.toml --poses bad.csv
failure a_track_that_is_not_there "none.csv: cannot open" sweep pair.toml --poses none.csv

# ---- JSON lines ----
run sweep pair.toml --az 0:20:10 --json
same json_lines_are_one_a_row "$(printf '%s\n' "$out" | grep -c '^{.*}$')" 5
if command -v python3 >/dev/null; then
    printf '%s\n' "$out" >rows.jsonl
    same json_lines_are_json "$(python3 -c '
import json
head, *rows, last = [json.loads(line) for line in open("rows.jsonl")]
print(head["rows"], head["shape"], [r["az_deg"] for r in rows], rows[0]["sigma_m2"] > 0, rows[0]["flags"], list(last))')" "3 [3] [0, 10, 20] True [] ['checksum']"
else
    skip "json_lines_are_json" "no python3"
fi
same json_and_csv_agree "$(printf '%s\n' "$out" | sed -n 's/.*"sigma_m2": \([^,]*\),.*/\1/p' | tr '\n' ' ')" "$(sweep pair.toml --az 0:20:10 | column 4 | tr '\n' ' ')"

# ---- maps ----
"$tool" sweep pair.toml --az 0:40:10 --el -20:20:20 -o map.npy 2>/dev/null
same a_map_is_numpys "$(od -An -c -N6 map.npy | tr -d ' ')" '223NUMPY'
same a_map_has_its_shape "$(head -1 map.npy | tr -d '\223' | LC_ALL=C cut -c10-)" "$(printf "%-117s" "{'descr': '<f8', 'fortran_order': False, 'shape': (5, 3, 2), }")"
same a_map_has_two_doubles_a_row "$(wc -c <map.npy | tr -d ' ')" "$((128 + 5 * 3 * 2 * 8))"
for python in python3 /usr/bin/python3; do
    $python -c 'import numpy' 2>/dev/null || continue
    "$tool" sweep pair.toml --az 0:40:10 --el -20:20:20 -o map.csv 2>/dev/null
    same numpy_reads_the_rows_of_the_csv "$($python -c '
import numpy
m = numpy.load("map.npy")
c = numpy.loadtxt("map.csv", delimiter=",", skiprows=2, usecols=(3, 5))
print(m.shape, bool((m.reshape(-1, 2) == c).all()))')" "(5, 3, 2) True"
    numpy=yes
    break
done
[ "${numpy:-}" ] || skip "numpy_reads_the_rows_of_the_csv" "no numpy"

# ---- exit codes ----
run sweep pair.toml --az 0:20:10 --el 75 --method zbuffer --resolution 16 --tolerance 1e-9
same a_tolerance_missed_exits_3 "$rc" 3
same and_says_how_often "$(printf '%s\n' "$err" | grep -c 'of 3 rows miss the tolerance 1e-09')" 1
same and_so_do_the_rows "$(printf '%s\n' "$out" | grep -c ',tolerance_not_met$' | awk '{ print ($1 > 0) }')" 1
run sweep pair.toml --az 0:20:10 --el 75 --method zbuffer --resolution 16
same a_forced_method_without_a_tolerance_exits_0 "$rc" 0
same and_nothing_speaks_of_one_missed "$(printf '%s\n' "$out$err" | grep -c 'tolerance_not_met\|miss')" 0

# ---- usage ----
usage_error nothing_varies "nothing varies" sweep demo
usage_error two_ways_of_poses "--az and --sphere both give the poses" sweep demo --az 0:1:1 --sphere 10
usage_error a_pose_beside_a_grid "--az and --direction both" sweep demo --az 0:1:1 --direction 0,0,1
usage_error two_poses_to_turn_from "--direction and --azel both" sweep demo --rotate x:0:1:1 --direction 0,0,1 --azel 1,1
usage_error range_without_a_step "A:B:STEP or one number, found '0:10'" sweep demo --az 0:10
usage_error range_of_four "A:B:STEP" sweep demo --az 0:10:1:1
usage_error range_of_words "A:B:STEP or one number, found 'north'" sweep demo --az north
usage_error step_of_zero "a STEP that leads from A to B" sweep demo --az 0:10:0
usage_error step_the_wrong_way "a STEP that leads from A to B" sweep demo --az 0:10:-1
usage_error too_many_digits "at most 15 are exact" sweep demo --az 0:1:0.12345678901234567
usage_error too_many_rows "more than 2^53" sweep demo --az 0:100000000:0.000001 --el 0:1000:0.1
usage_error euler_without_angles "three of XYZ" sweep demo --euler XYZ
usage_error euler_beside_a_direction "--direction and --euler both" sweep demo --euler XYZ:0:1:1,0,0 --direction 0,0,1
usage_error euler_of_two_angles "three angles" sweep demo --euler XYZ:0:1:1,0
usage_error euler_of_a_wrong_sequence "three of XYZ" sweep demo --euler XXY:0:1:1,0,0
usage_error rotate_about_nothing "axis u,v,w" sweep demo --rotate 0,0,0:0:1:1
usage_error rotate_without_a_range "A:B:STEP" sweep demo --rotate x
usage_error sphere_of_none "found '0'" sweep demo --sphere 0
usage_error no_jobs "found '0'" sweep demo --az 0:1:1 --jobs 0
# Errors of materials change neither sigma nor its bound, nor how finely shapes are divided for it.
bounds() { printf '%s\n' "$out" | grep -v '^#' | awk -F, '{ print $4, $6 }'; }
run sweep demo --az 0:40:20 --el 30 --material white=0.02,0.25,0.4,0.2
plain=$(bounds)
run sweep demo --az 0:40:20 --el 30 --material white=0.02,0.25+-0.01,0.4,0.2
same rows_with_errors_of_materials_have_the_bounds_of_those_without "$(bounds)" "$plain"

usage_error output_of_no_kind "FILE.csv, FILE.jsonl or FILE.npy, found 'x.txt'" sweep demo --az 0:1:1 -o x.txt
usage_error json_into_a_file "FILE.jsonl" sweep demo --az 0:1:1 --json -o x.csv
usage_error resume_without_a_file "--resume needs -o FILE" sweep demo --az 0:1:1 --resume
usage_error shard_of_a_map "lrcs merge" sweep demo --az 0:1:1 --shard 1/2 -o x.npy
for shard in 0/2 3/2 1 1/0 a/b 1.5/2; do
    usage_error "shard_$(echo $shard | tr /. __)" "expected K/N" sweep demo --az 0:1:1 --shard $shard
done
cp pair.toml scene.csv
usage_error output_over_the_scene "would overwrite scene.csv" sweep scene.csv --az 0:1:1 -o scene.csv
usage_error output_over_the_poses "would overwrite the poses" sweep demo --poses d.csv -o ./d.csv
usage_error one_letter_option_twice "-o is given twice" sweep demo -o a.csv -o b.csv
same nothing_is_left_behind "$(find . -name '*.partial' -o -name '.lrcs*' | wc -l | tr -d ' ')" 0
finish
