#!/bin/sh
# SPDX-License-Identifier: MIT
# What lrcs run writes never replaces what it read: refused under any name, the input intact.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
mkdir sub
printf 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n' >m.stl
printf 'mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n' >m.obj
printf 'newmtl red\nKd 1 0 0\n' >m.mtl
printf '[[part]]\nname = "a"\nfile = "m.stl"\n[[part]]\nname = "b"\nfile = "m.obj"\n' >scene.toml
ln -s m.stl soft.stl
ln m.stl hard.stl
cksum m.stl m.obj m.mtl scene.toml >before

# refused NAME INPUT SCENE OPTION PATH: a usage error that names the option and what it would hit.
refused() {
    usage_error "$1" "$4 $5: would overwrite $2" run "$3" "$4" "$5"
}
for option in --facets --image; do
    o=${option#--}
    refused "${o}_over_the_model" m.stl m.stl $option m.stl
    refused "${o}_over_the_model_by_another_spelling" m.stl m.stl $option sub/..//m.stl
    refused "${o}_over_the_model_by_its_full_path" m.stl m.stl $option "$scratch/m.stl"
    refused "${o}_over_the_model_through_a_symlink" m.stl m.stl $option soft.stl
    refused "${o}_over_a_model_given_by_symlink" soft.stl soft.stl $option m.stl
    refused "${o}_over_the_model_through_a_hard_link" m.stl m.stl $option hard.stl
    refused "${o}_over_the_obj" m.obj m.obj $option m.obj
    refused "${o}_over_the_material_file_of_an_obj" m.mtl m.obj $option m.mtl
    refused "${o}_over_the_scene_file" scene.toml scene.toml $option ./scene.toml
    refused "${o}_over_a_model_of_the_scene_file" m.stl scene.toml $option m.stl
    refused "${o}_over_a_material_file_of_the_scene_file" m.mtl scene.toml $option sub/../m.mtl
done
usage_error facets_and_image_under_one_name "name the same file" run demo --facets out --image out
usage_error facets_and_image_by_two_spellings "name the same file" run demo --facets out --image sub/../out
: >there
ln -s there link
usage_error facets_and_image_through_a_link "name the same file" run demo --facets there --image link
same no_output_was_written "$(ls out 2>/dev/null)" ""
same the_inputs_are_intact "$(cksum m.stl m.obj m.mtl scene.toml)" "$(cat before)"
same links_stay_links "$([ -L soft.stl ] && [ m.stl -ef hard.stl ] && echo yes)" yes

# ---- what is not an input is written ----
run run m.stl --facets m.csv --image sub/m.csv --image-size 16
same the_same_name_in_two_folders_is_two_files "$rc $(head -c 5 m.csv)$(head -c 4 sub/m.csv | tail -c 3)" "0 facetPNG"
run run m.stl --facets m.csv
same an_output_may_be_replaced "$rc" 0
run run demo --facets m.stl
same a_model_that_was_not_read_may_be_replaced "$(head -c 5 m.stl)" facet
finish
