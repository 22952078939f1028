#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep --poses as a time series: dates, joints in every row, light curves; and that what
# --resume, merge and plot promise of sweeps holds of these.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
cat >arm.toml <<'END'
[[part]]
name = "bus"
shape = "box"
size = [1, 1, 1]
[[part]]
name = "wing, left"
shape = "plate"
size = [2, 1]
translate = [3, 0, 0]
[part.joint]
axis = [1, 0, 0]
angle_deg = 5
[[part]]
name = "dish"
shape = "plate"
size = [1, 1]
translate = [-3, 0, 0]
[part.joint]
axis = [0, 1, 0]
angle_deg = 6
END
{
    echo 'time,x,y,z,"joint:wing, left",joint:dish'
    echo '2026-02-28T23:59:59.5Z,0,0,1,0,0'
    echo '2026-03-01T00:00:00Z,0,0.2,1,10,-20'
    echo '2026-03-01 00:01:00.25Z,0.1,0.2,1,25.5,40'
    echo '2026-03-02T00:00:00Z,0.1,0.2,1,-70,3'
} >track.csv
rows() { grep -v '^#' "$1" | sed 1d; }

run sweep arm.toml --poses track.csv -o rows.csv --plot curve.svg
same a_track_with_joints_is_swept "$rc $(rows rows.csv | wc -l | tr -d ' ')" "0 4"
same joints_are_columns_before_the_time "$(grep '^index' rows.csv)" 'index,"joint:wing, left",joint:dish,time,x,y,z,sigma_m2,sigma_dbsm,bound_m2,sigma_glint_m2,sigma_diffuse_m2,flags'
same dates_count_from_the_first "$(rows rows.csv | cut -d, -f2-4 | tr '\n' ' ')" "0,0,0 10,-20,0.5 25.5,40,60.75 -70,3,86400.5 "
same the_date_is_in_the_first_line "$(grep -c '; time_from=2026-02-28T23:59:59.5Z;' rows.csv)" 1
same a_light_curve_has_its_unit_and_date "$(grep -c '>time since 2026-02-28T23:59:59.5Z (s)<' curve.svg)" 1

# Each row is what a scene file with those angles gives.
n=0
while IFS=, read -r index wing dish time x y z sigma rest; do
    sed "s/^angle_deg = 5/angle_deg = $wing/; s/^angle_deg = 6/angle_deg = $dish/" arm.toml >one.toml
    direction=$(sed -n "$((index + 2))p" track.csv | awk -F, '{ print $2 "," $3 "," $4 }')
    run run one.toml --direction "$direction" --json
    [ "$(value sigma_m2)" = "$sigma" ] && n=$((n + 1))
done <<END
$(rows rows.csv)
END
same every_row_is_what_run_gives "$n" 4

# A light curve's axis is that of the data: sigma from 100 to 104 is no flat line above 0.
cat >plate.toml <<'END'
[[part]]
name = "p"
shape = "plate"
size = [1, 6.5]
END
printf 'time_s,x,y,z\n0,0,0,1\n10,0.01,0,1\n20,0.02,0,1\n' >short.csv
run sweep plate.toml --poses short.csv -o short.out.csv --plot short.svg
same seconds_have_their_unit "$(grep -c '>time (s)<' short.svg)" 1
same the_axis_is_not_from_0 "$(grep -c '>0</text>' short.svg)" 1
run sweep plate.toml --az 0 --el 88:90:1 -o cut.csv --plot cut.svg
same other_curves_are_from_0 "$(grep -c '>0</text>' cut.svg)" 1

# Shards, threads, JSON lines, resuming and drawing again: the same bytes.
run sweep arm.toml --poses track.csv --jobs 1
same any_number_of_threads "$out" "$(cat rows.csv)"
run sweep arm.toml --poses track.csv --shard 1/2 -o a.csv
run sweep arm.toml --poses track.csv --shard 2/2 -o b.csv
run merge b.csv a.csv -o whole.csv
same shards_make_the_whole "$rc $(cmp whole.csv rows.csv && echo same)" "0 same"
run plot rows.csv -o again.svg
same drawn_again_it_is_the_same "$rc $(cmp again.svg curve.svg && echo same)" "0 same"
run sweep arm.toml --poses track.csv -o rows.jsonl --plot third.svg
run plot rows.jsonl -o fourth.svg
same from_json_lines_too "$rc $(cmp third.svg fourth.svg && echo same)" "0 same"
sed '4q' rows.csv >part.csv.partial
run sweep arm.toml --poses track.csv -o part.csv --resume
same what_was_begun_goes_on "$rc $(cmp part.csv rows.csv && echo same)" "0 same"
sed -e 's/^1,10,/1,11,/' -e 4q rows.csv >part.csv.partial
rm part.csv
failure an_angle_that_is_not_the_row_s_is_refused "part.csv.partial" sweep arm.toml --poses track.csv -o part.csv --resume
sed 's/^1,10,/1,11,/' a.csv >damaged.csv
failure a_damaged_shard_is_refused "damaged.csv" merge damaged.csv b.csv -o no.csv
sed 's/,10,-20$/,11,-20/' track.csv >other.csv
sed '4q' rows.csv >part.csv.partial
failure another_file_of_poses_is_another_sweep "part.csv" sweep arm.toml --poses other.csv -o part.csv --resume

bad() { # NAME TEXT LINE...
    name=$1
    text=$2
    shift 2
    printf '%s\n' "$@" >bad.csv
    failure "$name" "$text" sweep arm.toml --poses bad.csv
}
bad a_day_that_is_none "line 2, column time: found '2026-02-29T00:00:00Z', expected seconds, or a date as" time,x,y,z 2026-02-29T00:00:00Z,0,0,1
bad an_hour_that_is_none "2026-02-28T24:00:00Z" time,x,y,z 2026-02-28T24:00:00Z,0,0,1
bad a_date_without_utc "expected seconds, or a date as" time,x,y,z 2026-02-28T23:00:00,0,0,1
bad a_date_with_half_a_fraction "2026-02-28T23:00:00.Z" time,x,y,z 2026-02-28T23:00:00.Z,0,0,1
bad seconds_after_dates "line 3, column time: found '5', expected a date as in the first row" time,x,y,z 2026-02-28T23:00:00Z,0,0,1 5,0,0,1
bad dates_after_seconds "line 3, column time: found '2026-02-28T23:00:00Z', expected a finite number" time,x,y,z 5,0,0,1 2026-02-28T23:00:00Z,0,0,1
bad an_angle_that_is_no_number "column joint:dish: found 'up', expected a finite number" time,x,y,z,joint:dish 0,0,0,1,up
bad one_joint_twice "two columns are the same" time,x,y,z,joint:dish,joint:dish 0,0,0,1,1,1
bad a_joint_of_nothing "expected joint:PART" time,x,y,z,joint: 0,0,0,1,1
bad a_track_of_nothing "bad.csv: no attitude in the file; expected rows of time,w,x,y,z (quaternion" ''
bad a_track_of_names_alone "bad.csv: no attitude in the file; expected rows of time,w,x,y,z (quaternion" time,x,y,z
printf 'az,el\n1,2\n' >bad.csv
run sweep arm.toml --poses bad.csv
same columns_that_are_no_pose_are_one_message "$rc $err" "1 lrcs: bad.csv: line 1: expected columns time,w,x,y,z (quaternion, body to observation) or time,x,y,z (direction to the laser)"
printf 'time,x,y,z,mo\033[2Jde\n0,0,0,1,1\n' >bad.csv
run sweep arm.toml --poses bad.csv
same a_notice_prints_no_control_characters "$rc $(printf '%s\n' "$err" | grep -c "^notice: bad.csv: column 'mo?\[2Jde' is not used")" "0 1"
printf 'time,x,y,z,joint:dsh\n0,0,0,1,1\n' >bad.csv
usage_error a_part_that_is_not_there "--poses: no part 'dsh' has a joint; the nearest is 'dish'" sweep arm.toml --poses bad.csv
printf 'time,x,y,z,joint:bus\n0,0,0,1,1\n' >bad.csv
usage_error a_part_without_a_joint "no part 'bus' has a joint" sweep arm.toml --poses bad.csv
usage_error joints_in_two_places "--joint and the joint columns of --poses both turn joints: give one" \
    sweep arm.toml --poses track.csv --joint dish:0:10:5
printf '2026-03-01T00:00:00Z,0,0,1\n2026-03-01T00:00:01Z,0,0,1\n' >bare.csv
run sweep plate.toml --poses bare.csv
same dates_need_no_names "$rc $(printf '%s\n' "$out" | grep '^1,' | cut -d, -f2)" "0 1"
printf 'time,x,y,z\n1999-12-31T23:59:59Z,0,0,1\n2000-02-29T00:00:00Z,0,0,1\n2100-03-01T00:00:00Z,0,0,1\n' >years.csv
run sweep plate.toml --poses years.csv
same years_have_their_days "$(printf '%s\n' "$out" | grep -E '^[12],' | cut -d, -f2 | tr '\n' ' ')" "5097601 3160857601 "
finish
