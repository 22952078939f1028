#!/bin/sh
# SPDX-License-Identifier: MIT
# Wrong command lines: exit 2, nothing on stdout, and a message that helps.
. "$(dirname "$0")/check.sh"

usage_error no_command_shows_the_usage "usage: lrcs COMMAND"
usage_error unknown_command_names_the_nearest "the nearest is verify" verfiy
usage_error option_before_a_command "a command is expected" --json
usage_error unknown_help_topic_names_the_nearest "the nearest is info" help infos
usage_error missing_scene "SCENE is missing" run
usage_error missing_kind "KIND is missing" shape
usage_error two_scenes "found 'a' and 'b'" run a b
usage_error verify_takes_no_operand "found 'x'" verify x

usage_error misspelt_option_names_the_nearest "'--dirction'; the nearest is --direction" run demo --dirction 1,0,0
run run demo --threads 2
same an_option_like_no_other_suggests_none "$rc $(printf '%s\n' "$err" | sed -n 1p)" "2 lrcs: unknown option '--threads'"
run xyzzy
same a_command_like_no_other_lists_all "$rc $(printf '%s\n' "$err" | sed -n 1p)" "2 lrcs: unknown command 'xyzzy'; expected one of run, image, profile, info, scene, shape, verify, converge, sweep, merge, plot, report, fit, vectors, compare"
usage_error shortened_option_names_the_whole "the nearest is --tolerance" run demo --tol=1e-3
usage_error single_dash_option "unknown option '-json'; the nearest is --json" run demo -json
usage_error option_of_another_command "unknown option '--radius'" run demo --radius 1
usage_error empty_option_name "unknown option '--'" run demo --
usage_error missing_value_at_the_end "--azel needs a value" run demo --azel
usage_error option_in_place_of_a_value "--azel needs a value" run demo --azel --json
usage_error empty_value "--azel needs a value" run demo --azel=
usage_error value_for_a_switch "--json takes no value" run demo --json=yes
usage_error option_given_twice "--azel is given twice" run demo --azel 1,2 --azel 1,2

usage_error two_poses "both give the pose" run demo --azel 1,2 --direction 0,0,1
usage_error direction_of_two_numbers "expected x,y,z" run demo --direction 1,2
usage_error direction_of_four_numbers "expected x,y,z" run demo --direction 1,2,3,4
usage_error direction_that_is_no_number "found '1,x,2'" run demo --direction 1,x,2
usage_error direction_nan "found 'nan,0,1'" run demo --direction nan,0,1
usage_error direction_beyond_doubles "found '1e999,0,1'" run demo --direction 1e999,0,1
usage_error direction_zero "not zero" run demo --direction 0,0,-0
usage_error azel_of_one_number "expected AZ,EL" run demo --azel 10
usage_error euler_without_angles "expected SEQ:a,b,c" run demo --euler XYZ
usage_error euler_mixed_letters "intrinsic" run demo --euler XyZ:1,2,3
usage_error euler_equal_neighbours "neighbours different" run demo --euler XXY:1,2,3
usage_error euler_other_letters "intrinsic" run demo --euler ABC:1,2,3
usage_error quaternion_of_three_numbers "expected w,x,y,z" run demo --quaternion 1,0,0
usage_error quaternion_zero "not zero" run demo --quaternion 0,0,0,0

usage_error tolerance_zero "> 0, found '0'" run demo --tolerance 0
usage_error tolerance_negative "found '-1e-3'" run demo --tolerance -1e-3
usage_error tolerance_no_number "found '1e-3x'" run demo --tolerance 1e-3x
usage_error tolerance_inf "found 'inf'" run demo --tolerance inf
usage_error unknown_method "auto, facet, zbuffer or exact" run demo --method ray
usage_error resolution_zero "found '0'" run demo --resolution 0
usage_error resolution_fraction "found '10.5'" run demo --resolution 10.5
usage_error resolution_huge "found '1e9'" run demo --resolution 1e9
usage_error unknown_unit "mm, cm, m, in, ft" run demo --unit yard
usage_error unit_zero "found '0'" run demo --unit 0
usage_error unit_of_a_scene_file "its own units" run demo --unit mm
usage_error image_size_without_image "needs --image" run demo --image-size 100
usage_error image_size_small "found '4'" run demo --image x.png --image-size 4
usage_error image_to_stdout "standard output" run demo --image -
usage_error image_of_another_format "expected FILE.png, found 'x.JPG'" run demo --image x.JPG
usage_error json_and_csv_on_stdout "both want standard output" run demo --json --facets -
usage_error one_file_for_two "the same file" run demo --image "$scratch/x" --facets "$scratch/x"

usage_error material_that_no_facet_has "no material named 'fool'; the nearest is 'foil'" run demo --material fool=1,0.2,0.3,1
usage_error material_of_three_numbers "A,B,s,m" run demo --material foil=1,0.2,0.3
usage_error three_numbers_are_no_library_name "(four finite numbers), found '1,0.2,0.3'" run demo --material 1,0.2,0.3
usage_error material_unknown_in_library "the nearest in the library is solar-cell" run demo --material foil=solar-cel
usage_error material_negative_A "A is negative" run demo --material -1,0,0.2,0
usage_error a_refused_material_is_quoted "found '-1,0,0.2,0', expected A, B, m >= 0 and s > 0" run demo --material -1,0,0.2,0
usage_error a_material_like_no_other_lists_all "no material named 'nosuchmat'; it has 'foil', 'white'" run demo --material nosuchmat=1,1,1,1
usage_error two_sided_names_what_there_is "found 'xyz'; it has, among others, 'bus', 'dish'" run demo --two-sided xyz
usage_error two_sided_names_the_nearest "found 'dsh'; the nearest is 'dish'" run demo --two-sided dsh
usage_error material_negative_m "m is negative" run demo --material 1,0,0.2,-1
usage_error material_no_slope "s is 0" run demo --material 1,0,0,0
usage_error material_nan "found 'nan,0,1,1'" run demo --material nan,0,1,1
usage_error material_no_name "expected NAME=" run demo --material =1,0,0.2,0
usage_error material_bad_colour "#RRGGBB" run demo --material '#12345G=1,0,0.2,0'
usage_error material_colour_that_nothing_has "#010203" run demo --material '#010203=1,0,0.2,0'

usage_error unknown_kind "the nearest is sphere" shape spere
usage_error a_kind_like_no_other_lists_all "'cube'; expected one of plate, disc, box, sphere" shape cube
usage_error missing_radius "sphere needs --radius" shape sphere
usage_error missing_size "box needs --size a,b,c" shape box
usage_error size_of_two_for_a_box "expected a,b,c" shape box --size 1,2
usage_error size_of_three_for_a_plate "expected a,b" shape plate --size 1,2,3
usage_error missing_length "cylinder needs --length" shape cylinder --radius 1
usage_error missing_radius2 "frustum needs --radius2" shape frustum --radius 1 --length 1
usage_error cone_without_height "--half-angle or --length" shape cone --radius 1
usage_error cone_with_both "not both" shape cone --radius 1 --length 1 --half-angle 20
usage_error length_of_a_sphere "takes no --length" shape sphere --radius 1 --length 2
usage_error half_angle_of_a_cylinder "takes no --half-angle" shape cylinder --radius 1 --length 1 --half-angle 3
usage_error size_of_a_disc "takes no --size" shape disc --radius 1 --size 1,1
usage_error half_angle_90 "0 < DEG < 90" shape cone --radius 1 --half-angle 90
usage_error negative_radius "found '-1'" shape sphere --radius -1
usage_error radius_too_large "radius: expected metres, 0 .. 1e100, found a larger number" shape sphere --radius 1e101
failure radius_too_small_for_closed_forms "lengths are 0 or 1e-150 .. 1e100 m" shape sphere --radius 1e-200
usage_error aspect_beyond_180 "0 .. 180" shape disc --radius 1 --aspect 180.5
usage_error aspect_negative "found '-1'" shape disc --radius 1 --aspect -1
usage_error direction_of_a_disc "takes --aspect" shape disc --radius 1 --direction 0,0,1
usage_error aspect_and_direction "both say" shape plate --size 1,1 --aspect 1 --direction 0,0,1
usage_error parts_unknown "wall or all" shape dome --radius 1 --parts cap
usage_error parts_of_a_sphere "no caps" shape sphere --radius 1 --parts wall

finish
