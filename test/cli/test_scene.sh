#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs scene: the scene file of a model is TOML, names all of its materials, marks what is assumed, and
# means what the model means, to the bit.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
mkdir deep deep/er other

# Names that TOML and shells dislike, one name twice, a material without a name, a transparent one.
cat >deep/m.mtl <<'END'
newmtl gold "foil" \ 1
Kd 1 0.8 0
newmtl SOLAR*
Kd 0 0 0.5
newmtl glass
d 0
END
cat >deep/m.obj <<'END'
mtllib m.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 3 0 0.1
v 3 1 0.3
v 7 0 0
v 7 1 0
v 15 0 0
v 15 1 0
f 1 2 3
o wing "left"
usemtl gold "foil" \ 1
f 1 2 3 4
usemtl SOLAR*
f 2 5 6 3
usemtl glass
f 5 7 8 6
usemtl solar-cell
f 7 9 10 8
END
cksum deep/m.obj deep/m.mtl >before

usage_error it_asks_for_a_file "give -o FILE.toml" scene deep/m.obj
usage_error a_scene_is_toml "-o: expected FILE.toml, found 'x.txt'" scene deep/m.obj -o x.txt
usage_error a_scene_file_needs_no_other "expected a model, found a scene file" scene demo -o x.toml
: >there.toml
usage_error what_is_there_is_not_lost "'there.toml' exists, and may have been edited" scene deep/m.obj -o there.toml
failure a_model_must_be_there "none.obj" scene none.obj -o x.toml
same nothing_was_written "$(ls x.toml 2>&1 >/dev/null | wc -l) $(wc -c <there.toml | tr -d ' ')" "1 0"

# means NAME MODEL SCENE OPTIONS...: the scene file has the model's hash, and its sigma from two poses.
means() {
    name=$1
    model=$2
    file=$3
    shift 3
    run scene "$model" -o "$file" "$@"
    made=$rc
    same "${name}_is_made" "$rc" 0
    same "${name}_says_nothing_on_stdout" "$out" ""
    for azel in 0,90 40,30; do
        run run "$model" --azel $azel --json --method facet "$@"
        want="$(value scene_hash) $(value sigma_m2) $(value sigma_glint_m2)"
        sources=$(printf '%s\n' "$out" | sed -n 's/.*"source": "\([a-z]*\)".*/\1/p' | sort | uniq -c | tr -s ' \n' ' ')
        run run "$file" --azel $azel --json --method facet
        same "${name}_has_the_same_sigma_from_$azel" "$(value scene_hash) $(value sigma_m2) $(value sigma_glint_m2)" "$want"
        same "${name}_has_the_same_sources_from_$azel" \
            "$(printf '%s\n' "$out" | sed -n 's/.*"source": "\([a-z]*\)".*/\1/p' | sort | uniq -c | tr -s ' \n' ' ')" "$sources"
    done
}
means a_model deep/m.obj a.toml
means a_model_in_inches deep/m.obj b.toml --unit in
means a_model_of_another_unit deep/m.obj c.toml --unit 0.0123456789012345678
means a_model_with_its_glass deep/m.obj d.toml --keep-transparent
means a_model_with_materials deep/m.obj e.toml --material 'SOLAR*=0.1,0.2,0.30000000000000004,1e-7' --material 'gold*=mli-gold'
means a_model_with_errors deep/m.obj err.toml --material 'SOLAR*=0.1+-0.01,0.2,0.3+-0.025,1'
same errors_are_kept "$(grep -E '^[ABsm]_error' err.toml | tr '\n' ' ')" "A_error = 0.01 s_error = 0.025 "
means a_scene_in_another_folder deep/m.obj other/f.toml
means a_scene_further_down deep/m.obj deep/er/g.toml
means a_scene_beside_it deep/m.obj deep/h.toml
means an_absolute_path "$scratch/deep/m.obj" i.toml
(cd deep/er && "$tool" scene ../m.obj -o ../../other/j.toml 2>/dev/null && "$tool" run ../../other/j.toml --method facet >/dev/null 2>&1 && [ -s ../../other/j.toml ])
same a_path_with_dots "$?" 0
same the_model_is_intact "$(cksum deep/m.obj deep/m.mtl)" "$(cat before)"
same a_path_is_relative_to_the_scene "$(grep -h '^file' a.toml other/f.toml deep/er/g.toml deep/h.toml | tr '\n' ' ')" \
    'file = "deep/m.obj" file = "../deep/m.obj" file = "../m.obj" file = "m.obj" '
run scene deep/m.obj -o -
same a_dash_is_stdout "$rc $(printf '%s\n' "$out" | grep -c '^\[\[part\]\]')" "0 1"
same the_unit_is_told_as_a_guess "$(grep -c '^# GUESS: m.obj: no unit is stated: metres are assumed, it is 15 m across' a.toml) $(grep -c '^unit = "in"' b.toml)" "1 1"
same defaults_are_told_as_guesses "$(grep -c '^assumed = true    # GUESS' a.toml)" 4
same names_suggest_materials "$(grep -A2 'name = "SOLAR' a.toml | grep -c '^# like = "solar-cell"')" 1
same colours_are_told "$(grep -c 'colour #FFCC00' a.toml)" 1
same objects_are_told "$(grep -c '8 facets  wing "left"' a.toml)" 1
same the_library_is_told_as_a_guess "$(grep -c '^like = "solar-cell"   # GUESS: .* illustrative' a.toml)" 1
same published_entries_of_the_library_are_marked "$(sed -n "/Names of the library/,/ideal-glint/p" a.toml | tr " " "\n" | grep -c "^paint-.*[*],")" 3
same glass_is_told "$(grep -c 'fully transparent: left out' a.toml) $(grep -c '^keep_transparent = true' d.toml)" "1 1"

# An edited file: numbers that are no longer marked as assumed count as given; others are reported.
sed 's/^assumed = true.*//' a.toml >edited.toml
run run edited.toml --json --method facet
same an_edited_material_is_given "$(printf '%s\n' "$out" | grep -c '"source": "given"')" 3
sed 's/^A = 1$/A = 0.5/' a.toml >half.toml
run run half.toml --method facet
same assumed_numbers_stay_assumed "$(printf '%s\n' "$out" | grep -c 'assumed, as the scene file says')" 1
same and_are_told "$(printf '%s\n' "$err" | grep -c '^notice: 5 of 9 facets have GUESSED materials (assumed = true in the scene file)')" 1

if python3 -c 'import tomllib' 2>/dev/null; then
    python3 - <<'END' || not_ok the_python_ends_well
import tomllib
from tap import check
scene = tomllib.load(open("a.toml", "rb"))
names = [m["name"] for m in scene["material"]]
check("every_material_that_is_used_is_there", sorted(names) == sorted(['gold "foil" \\ 1', "SOLAR*", "glass", "solar-cell", "default"]), names)
check("every_name_is_mapped", [m["name"] for m in scene["map"]] == [m["material"] for m in scene["map"]] == [n for n in names if n != "default"])
check("what_has_no_name_is_the_default", scene["default_material"] == "default")
END
else
    skip what_toml_reads "no tomllib"
fi

if [ -d "$models" ]; then
    for model in skylab.3ds aura.3ds kepler.obj new_horizons_antenna.stl; do
        means "$(echo $model | tr . _)" "$models/$model" "$model.toml" --unit cm
    done
else
    skip real_models "$models is not there"
fi
finish
