#!/bin/sh
# SPDX-License-Identifier: MIT
# Which materials a name on the command line or in a scene file stands for: patterns, letters of the
# other case; and which similar names an error message suggests.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# Four plates side by side, of 1, 2, 4 and 8 m2, under materials of their own: with A = 0, B = 1, m = 0
# a material returns 4 pi times its area from the front, so sigma / 4 pi says which are bound.
cat >m.mtl <<'END'
newmtl SOLAR_1
Kd 0 0 0.5
newmtl SOLAR_2
Kd 0 0 0.6
newmtl Gold*Foil
Kd 1 0.8 0
newmtl grey
Kd 0.5 0.5 0.5
END
cat >m.obj <<'END'
mtllib m.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 3 0 0
v 3 1 0
v 7 0 0
v 7 1 0
v 15 0 0
v 15 1 0
usemtl SOLAR_1
f 1 2 3 4
usemtl SOLAR_2
f 2 5 6 3
usemtl Gold*Foil
f 5 7 8 6
usemtl grey
f 7 9 10 8
END
# areas NAME WANT OPTIONS...: the area, m2, of the plates that reflect; the others are dark.
areas() {
    name=$1
    want=$2
    shift 2
    run run m.obj --unit m --json --method facet "$@" --material 0,0,0.2,0
    same "$name" "$(value sigma_m2 | awk '{ printf "%.9g", $1 / (4 * 3.14159265358979323846) }')" "$want"
}
lit=0,1,0.2,0
areas a_name_binds_its_material 1 --material SOLAR_1=$lit
areas a_star_stands_for_any_characters 3 --material "SOLAR*=$lit"
same and_nothing_is_said_of_it "$(printf '%s\n' "$out" | grep -c 'these letters')" 0
areas a_question_mark_for_one 3 --material "SOLAR_?=$lit"
usage_error but_not_for_none "no material named 'SOLAR_1?'; the nearest is 'SOLAR_1'" run m.obj --material "SOLAR_1?=$lit"
areas a_star_alone_is_every_name 15 --material "*=$lit"
areas a_name_with_a_star_is_itself_first 4 --material "Gold*Foil=$lit"
areas letters_of_the_other_case_serve 8 --material GREY=$lit
same and_it_is_told "$(printf '%s\n' "$out" | grep -c "\"--material 'GREY': no material has exactly that name; taken for 'grey', ignoring case\"")" 1
areas in_patterns_too 3 --material "solar*=$lit"
same which_is_told "$(printf '%s\n' "$out" | grep -c "\"--material 'solar\*': .* taken for 'SOLAR_1' and others")" 1
areas a_full_name_goes_before_a_pattern 2 --material SOLAR_1=0,0,0.2,0 --material "SOLAR*=$lit"
areas whichever_is_given_first 2 --material "SOLAR*=$lit" --material SOLAR_1=0,0,0.2,0
areas and_before_letters_of_the_other_case 8 --material grey=$lit --material Grey=0,0,0.2,0
areas which_go_before_a_pattern 8 --material Grey=$lit --material "*=0,0,0.2,0"
areas of_two_patterns_the_last_holds 12 --material "*=$lit" --material "SOL*=0,0,0.2,0"

# The errors of numbers from one statement are fully correlated: they add up, and not their squares.
# share NAME WANT OPTIONS...: the deviation over sigma.
share() {
    name=$1
    want=$2
    shift 2
    run run m.obj --unit m --json --method facet "$@" --material 0,0,0.2,0
    near "$name" "$(printf '%s\n' "$out" | awk -F'[:,]' '/"sigma_m2"/ { s = $2 } /"material_uncertainty"/ { d = $3 } END { printf "%.15g", d / s }')" "$want"
}
share a_patterns_errors_are_one 0.1 --material 'SOLAR*=0,1+-0.1,0.2,0'
share names_that_differ_in_case_too 0.1 --material 'solar_?=0,1+-0.1,0.2,0'
share two_statements_are_two 0.0745355992499930 --material SOLAR_1=0,1+-0.1,0.2,0 --material SOLAR_2=0,1+-0.1,0.2,0
share a_published_material_has_one_error 0.0227272727272727 --material SOLAR_1=paint-white-silicate --material SOLAR_2=paint-white-silicate
same it_is_told_as_published "$(printf '%s\n' "$out" | grep -c '"source": "published"') $(printf '%s\n' "$out" | grep -c "solar reflectance of Fortescue.*Lambert's law is assumed")" "2 1"

usage_error a_misspelt_name_lists_what_is_like_it "no material named 'SOLRA_1'; the nearest is 'SOLAR_1', then 'SOLAR_2', " \
    run m.obj --material SOLRA_1=1,1,1,1
usage_error a_part_of_a_name_finds_it "the nearest is 'Gold*Foil'" run m.obj --material foil=1,1,1,1
usage_error a_colour_lists_the_nearest "the colour #000090; the nearest is #000099, then #000080, #808080" \
    run m.obj --material '#000090=1,1,1,1'

# The same in a scene file.
scene() {
    printf 'default_material = "dark"\n[[part]]\nname = "p"\nfile = "m.obj"\nunit = "m"\n'
    printf '[[material]]\nname = "lit"\nA = 0\nB = 1\ns = 0.2\nm = 0\n'
    printf '[[material]]\nname = "dark"\nA = 0\nB = 0\ns = 0.2\nm = 0\n'
    while [ $# -gt 0 ]; do
        printf '[[map]]\nname = "%s"\nmaterial = "%s"\n' "$1" "$2"
        shift 2
    done
}
# maps NAME WANT MAP MATERIAL...
maps() {
    name=$1
    want=$2
    shift 2
    scene "$@" >s.toml
    run run s.toml --json --method facet
    same "$name" "$(value sigma_m2 | awk '{ printf "%.9g", $1 / (4 * 3.14159265358979323846) }')" "$want"
}
maps a_map_takes_patterns 3 "SOLAR*" lit
maps a_full_name_in_a_map_goes_first 2 SOLAR_1 dark "SOL*" lit
maps a_map_takes_letters_of_the_other_case 8 Grey lit
same and_says_so "$(printf '%s\n' "$out" | grep -c '\[\[map\]\] name = ."Grey.":.* taken for .grey.,')" 1
scene grie lit >s.toml
run run s.toml --method facet
same a_map_that_nothing_matches_lists_what_is_like_it "$(printf '%s\n' "$err" | grep -c "^notice: \[\[map\]\] name = \"grie\": no material of a model has that name; the nearest is 'grey', then")" 1
scene "SOL*" lit >s.toml
run run s.toml --json --method facet --material "l?t=0,0.5,0.2,0"
same a_pattern_means_materials_of_the_scene_file_too "$(value sigma_m2 | awk '{ printf "%.9g", $1 / (4 * 3.14159265358979323846) }')" 1.5
finish
