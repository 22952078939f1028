#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep over what changes in the scene itself: every row is what lrcs run says of that scene.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# scene ANGLE S RADIUS: a bus with a wing on a joint and a tank, beside a model from a file.
scene() {
    cat <<END
[[material]]
name = "gold"
A = 1
B = 0.1
s = $2
m = 1
[[part]]
name = "bus"
shape = "box"
size = [1, 1, 1]
material = "gold"
[[part]]
name = "wing: left"
shape = "plate"
size = [2, 1]
translate = [1.6, 0, 0]
material = "solar-cell"
[part.joint]
axis = [1, 0, 0]
angle_deg = $1
[[part]]
name = "wing, right"
shape = "plate"
size = [2, 1]
translate = [-1.6, 0, 0]
[part.joint]
axis = [1, 0, 0]
angle_deg = $1
[[part]]
name = "tank"
shape = "cylinder"
radius = $3
length = 1
translate = [0, 0, 0.6]
material = "gold"
[[part]]
name = "nose"
shape = "cone"
radius = 0.2
half_angle_deg = 20
translate = [0, 0, 2]
[[part]]
name = "fin"
file = "fin.obj"
END
}
printf 'v 0 0 -1\nv 1 0 -1\nv 0 1 -1.5\nf 1 2 3\n' >fin.obj
scene 10 0.2 0.3 >base.toml

# rows COLUMNS ARGUMENTS...: of a sweep.
rows() {
    columns=$1
    shift
    "$tool" sweep "$@" --tolerance 1e-3 2>/dev/null | grep -v '^#' | sed 1d | cut -d, -f"$columns"
}
# answer ANGLE S RADIUS: what run says of a scene file with these.
answer() {
    scene "$1" "$2" "$3" >one.toml
    run run one.toml --tolerance 1e-3 --azel 40,30 --json
    echo "$(value sigma_m2),$(value sigma_dbsm),$(value bound_m2)"
}

wings='wing: left,wing, right'
same a_joint_turns "$(rows 3-5 base.toml --joint '*:10:50:20' --azel 40,30)" "$(answer 10 0.2 0.3; answer 30 0.2 0.3; answer 50 0.2 0.3)"
same several_joints_by_name "$(rows 3-5 base.toml --joint "$wings:30" --azel 40,30)" "$(answer 30 0.2 0.3)"
same one_joint_of_two_is_another_scene "$(rows 3-5 base.toml --joint 'wing: left:30' --azel 40,30 | grep -c "$(answer 30 0.2 0.3)")" 0
same a_material_changes "$(rows 3-5 base.toml --vary gold.s:0.1:0.3:0.1 --azel 40,30)" "$(answer 10 0.1 0.3; answer 10 0.2 0.3; answer 10 0.3 0.3)"
same a_shape_changes "$(rows 3-5 base.toml --vary tank.radius:0.3:0.5:0.1 --azel 40,30)" "$(answer 10 0.2 0.3; answer 10 0.2 0.4; answer 10 0.2 0.5)"
sed 's/^length = 1$/length = 1.5/' base.toml >longer.toml
run run longer.toml --tolerance 1e-3 --azel 40,30 --json
same a_length_changes "$(rows 3 base.toml --vary tank.length:1:1.5:0.5 --azel 40,30 | tail -1)" "$(value sigma_m2)"
same scenes_come_before_poses "$(rows 4-5 base.toml --el 30 --az 40 --vary gold.s:0.1 --joint '*:50' | cut -d, -f1) $(rows 1-5 base.toml --az 40:41:1 --el 30 --joint '*:10:30:20' | cut -d, -f1-4 | tr '\n' ' ')" "30 0,10,40,30 1,10,41,30 2,30,40,30 3,30,41,30 "
same two_of_them_make_a_map "$(rows 4-6 base.toml --vary gold.s:0.1:0.2:0.1 --joint '*:10:50:40' --azel 40,30)" "$(answer 10 0.1 0.3; answer 50 0.1 0.3; answer 10 0.2 0.3; answer 50 0.2 0.3)"
same two_parameters_of_one_material "$(rows 4-6 base.toml --vary gold.s:0.1 --vary gold.A:1 --azel 40,30)" "$(answer 10 0.1 0.3)"
run run base.toml --tolerance 1e-3 --azel 40,30 --json --material gold=1,0.1,0.1,1
same on_top_of_the_command_line "$(rows 3 base.toml --vary gold.s:0.1 --azel 40,30 --material gold=1,0.1,0.7,1)" "$(value sigma_m2)"
run sweep base.toml --vary gold.s:0.1:0.2:0.1 --vary tank.radius:0.3 --joint 'wing, right:1:2:1' --azel 40,30 --json --tolerance 1e-2
same the_head_says_each "$(printf '%s\n' "$out" | head -1 | grep -c '"rows": 4, "shape": \[2, 2\], "columns": \["gold.s", "tank.radius", "wing, right.joint_deg"\], "vary": "gold.s:0.1:0.2:0.1 and tank.radius:0.3", "joint": "wing, right:1:2:1", "azel": "40,30"')" 1
run sweep base.toml --joint 'wing, right:1:2:1' --azel 40,30 --tolerance 1e-2
same a_column_with_a_comma_is_quoted "$(printf '%s\n' "$out" | sed -n 2p | cut -d, -f2,3)" '"wing, right.joint_deg"'

what='base.toml --joint *:10:50:20 --az 0:60:20 --tolerance 1e-2'
set -f
for jobs in 1 3; do
    # shellcheck disable=SC2086
    "$tool" sweep $what --jobs $jobs -o whole.$jobs.csv 2>/dev/null
    # shellcheck disable=SC2086
    "$tool" sweep $what --shard $jobs/3 -o part.$jobs.csv 2>/dev/null
done
# shellcheck disable=SC2086
"$tool" sweep $what --shard 2/3 -o part.2.csv 2>/dev/null
"$tool" merge part.1.csv part.2.csv part.3.csv -o joined.csv
head -c 700 whole.1.csv >again.csv.partial
# shellcheck disable=SC2086
"$tool" sweep $what --resume -o again.csv 2>/dev/null
for other in whole.3 joined again; do
    if cmp -s whole.1.csv $other.csv; then ok "the_same_bytes_in_$other"; else not_ok "the_same_bytes_in_$other"; fi
done

# One pose a scene: the scenes themselves are built in threads.
for jobs in 1 3; do
    "$tool" sweep base.toml --joint '*:0:60:5' --azel 40,30 --tolerance 1e-2 --jobs $jobs >jobs.$jobs 2>/dev/null
done
same scenes_in_threads_are_the_same_bytes "$(wc -l <jobs.1 | tr -d ' ') $(cmp jobs.1 jobs.3 && echo same)" "16 same"

usage_error a_part_without_a_joint "no part 'bus' has a joint; the nearest is" sweep base.toml --joint bus:0:1:1
usage_error a_scene_without_joints "no part of the scene has a joint" sweep fin.obj --joint fin:0:1:1
usage_error a_joint_without_a_range "expected PART:A:B:STEP" sweep base.toml --joint tank
usage_error a_range_after_an_equals_sign "found 'foo=1:2:1'" sweep base.toml --vary foo=1:2:1
usage_error a_key_that_is_none "the nearest is .radius" sweep base.toml --vary tank.radios:0:1:1
usage_error a_material_that_is_none "no material 'god'; the nearest is 'gold'" sweep base.toml --vary god.s:0.1:0.2:0.1
usage_error a_slope_of_zero "gold.s cannot be 0" sweep base.toml --vary gold.s:0:1:1
usage_error a_negative_amplitude "gold.A cannot be -1" sweep base.toml --vary gold.A:1:-1:-1
usage_error a_radius_of_a_box "no part 'bus' has radius; the nearest is" sweep base.toml --vary bus.radius:1:2:1
usage_error a_negative_radius "radius of 'tank' cannot be -1" sweep base.toml --vary tank.radius:-1:1:1
usage_error a_cone_has_its_half_angle_or_its_length "no part 'nose' has length; the nearest is 'tank'" sweep base.toml --vary nose.length:1:2:1
usage_error a_half_angle_of_90 "half_angle_deg of 'nose' cannot be 90" sweep base.toml --vary nose.half_angle_deg:10:90:10
usage_error a_dimension_of_a_file "no part 'fin' has size_x" sweep base.toml --vary fin.size_x:1:2:1
finish
