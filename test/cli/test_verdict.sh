#!/bin/sh
# SPDX-License-Identifier: MIT
# What a run says beside its bound: sizes that rest on an assumed unit, back sides that return
# nothing, glints of facets too coarse for them, where materials come from, which files were read.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# A plate of 2 x 1 as a model: seen from behind it returns nothing.
cat >plate.obj <<'END'
o dish
v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 0
usemtl skin
f 1 2 3 4
END

# cube SIZE: a closed cube, beside the plate.
cube() {
    awk -v a="$1" 'BEGIN { print "o bus"
        for (i = 0; i < 8; i++) print "v", a * (i % 2) - 5 * a, a * (int(i / 2) % 2), a * int(i / 4)
        print "usemtl foil\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6" }'
}

# ---- the unit ----
run run plate.obj
same an_assumed_unit_is_told "$(printf '%s\n' "$err" | grep -c '^notice: plate.obj: no unit is stated: metres are assumed, it is 2 m across$')" 1
same and_left_open "$(printf '%s\n' "$out" | grep -c '^  unit       metres are assumed: no unit is stated for plate.obj$')" 1
same the_box_is_in_metres "$(printf '%s\n' "$out" | sed -n 's/^box  *//p')" "0, 0, 0 .. 2, 1, 0 m"
run run plate.obj --unit in --json
same a_stated_unit_is_not "$(printf '%s\n' "$out" | grep -c 'metres are assumed') $(value unit)" '0 "in"'
same and_the_box_follows "$(value box_max_m | tr -d '[]')" "0.050799999999999998, 0.025399999999999999, 0"
cube 4000 >big.obj
run run big.obj
same an_unlikely_size_is_told_with_others "$(printf '%s\n' "$err" | grep -c 'it is 4000 m across, which is unlikely for a spacecraft: it would be 4 m in mm, 40 m in cm, 101.6 m in in (state its unit)')" 1
cube 0.01 >small.obj
run run small.obj
same one_too_small_for_any_unit "$(printf '%s\n' "$err" | grep -c 'it is 0.01 m across, which is unlikely for a spacecraft (state its unit)')" 1
printf '[[part]]\nname = "p"\nfile = "plate.obj"\n' >bare.toml
printf 'unit = "m"\n[[part]]\nname = "p"\nfile = "plate.obj"\n' >stated.toml
printf '[[part]]\nname = "p"\nfile = "plate.obj"\nunit = 2\n' >each.toml
for scene in bare:1 stated:0 each:0; do
    run run ${scene%:*}.toml
    same "a_scene_file_${scene%:*}" "$(printf '%s\n' "$err" | grep -c 'no unit is stated')" "${scene#*:}"
done

# ---- ignored input ----
printf '[[part]]\nname = "p"\nfile = "plate.obj"\nunit = "m"\n[[map]]\nname = "skin"\nmaterial = "paint-white"\n[[map]]\nname = "skins"\nmaterial = "paint-white"\n[[map]]\ncolour = "#102030"\nmaterial = "paint-white"\n' >map.toml
run run map.toml
same maps_that_match_nothing_are_told "$(printf '%s\n' "$err" | grep '\[\[map\]\]' | tr '\n' ' ')" "notice: [[map]] name = \"skins\": no material of a model has that name; the nearest is 'skin' notice: [[map]] colour = \"#102030\": no material of a model has that colour "

# ---- back sides ----
# A plate of 2 m2 from behind at cos = 0.8, B = 0.5, m = 1: 4 pi 0.5 0.8 0.8 (2 0.8) = 6.43398175455.
brdf=0,0.5,0.2,1
back="--unit m --direction 0.6,0,-0.8 --material $brdf"
# shellcheck disable=SC2086
run run plate.obj $back --json
same backs_return_nothing "$(value sigma_m2)" 0
sides() { value back_sides | sed "s/.*\"$1\": //; s/[,}].*//"; }
near their_area "$(sides area_m2)" 1.6
near is_all_of_the_silhouette "$(sides share_of_silhouette)" 1
near what_they_would_return "$(sides sigma_two_sided_m2)" 6.43398175455
for what in all open skin dish plate.obj; do
    # shellcheck disable=SC2086
    run run plate.obj $back --two-sided $what --json
    near "two_sided_${what}_returns_it" "$(value sigma_m2)" 6.43398175455
    same "and_no_back_is_left_by_$what" "$(sides area_m2)" 0
done
# shellcheck disable=SC2086
run run plate.obj $back
same the_verdict_says_it "$(printf '%s\n' "$out" | grep -A1 '^  back sides 1.6 m2, 100 % of the silhouette, return nothing; if they reflected, sigma would be$' | grep -c '6.43398 m2: --two-sided open, or all')" 1
# shellcheck disable=SC2086
run run plate.obj $back --explain
same explain_shows_the_difference "$(printf '%s\n' "$out" | grep '^  two_sided ' | grep -c '+6.43 m2')" 1
# shellcheck disable=SC2086
usage_error two_sided_of_nothing "--two-sided: expected all, open, or a part or material of the scene, found 'none'" run plate.obj $back --two-sided none
# A closed object beside an open one: the open one alone reflects from behind.
{ cube 1 && sed 's/^f .*/f 9 10 11 12/' plate.obj; } >both.obj
for what in open dish; do
    run run both.obj --unit m --material $brdf --direction 0.6,0,-0.8 --two-sided $what --json
    printf '%s\n' "$out" | grep -v 'seconds\|options' >$what.json
done
same open_is_the_dish "$(cmp open.json dish.json && grep -c '"name": "foil".*"two_sided": false' open.json)$(grep -c '"name": "skin".*"two_sided": true' open.json)" 11
# In a sweep too, where scenes are varied.
printf '[[part]]\nname = "p"\nfile = "plate.obj"\nunit = "m"\n[part.joint]\naxis = [0,0,1]\norigin = [0,0,0]\nangle_deg = 0\n' >turn.toml
"$tool" sweep turn.toml --joint p:0:90:90 --direction 0,0,-1 --two-sided all >turn.csv 2>/dev/null
same a_varied_scene_is_two_sided "$(grep '^[01],' turn.csv | awk -F, '$3 > 0' | wc -l | tr -d ' ') $(head -1 turn.csv | grep -c '; two-sided=all$')" "2 1"

# ---- the glint ----
# A tube of 12 flats of two triangles each, round by its smoothing group, seen along the normal of one,
# which alone shines.
awk 'BEGIN { pi = 3.14159265358979312; print "o tube\ns 1"
    for (i = 0; i < 12; i++) { a = (i + 0.5) * pi / 6; printf "v %.15g %.15g 0\nv %.15g %.15g 4\n", cos(a), sin(a), cos(a), sin(a) }
    for (i = 0; i < 12; i++) { j = (i + 1) % 12; print "f", 2 * i + 1, 2 * j + 1, 2 * j + 2, 2 * i + 2 } }' >tube.obj
tube='tube.obj --unit m --material 1,0.1,0.05,1'
# shellcheck disable=SC2086
run run $tube --azel 60,0 --json
same a_coarse_glint_is_found "$(value coarse_glint | sed 's/: [0-9.]*[0-9][0-9]/: N/g')" '{"parts": 1, "sigma_glint_m2": N, "error_estimate_m2": N, "one_facet_dominates": true}'
# shellcheck disable=SC2086
run run $tube --azel 60,0
same and_told_in_words "$(printf '%s\n' "$out" | grep -c '^  glint      [0-9.]* % of sigma from facets too coarse for it')" 1
# shellcheck disable=SC2086
run run $tube --azel 60,0 --normals auto
same not_where_normals_are_curved "$(printf '%s\n' "$out" | grep -c 'too coarse')" 0

# In a sweep: told before it, and peaks along a facet's own normal are marked. Its normals are at
# 0, 30, .. deg.
# shellcheck disable=SC2086
run sweep $tube --az 0:355:5 --el 0 -o tube.csv --brightest 3
same a_sweep_tells_of_coarse_glints "$(printf '%s\n' "$err" | grep -c '^notice: glint: 1 curved part is too coarse for')" 1
same peaks_of_facet_normals_are_marked "$(printf '%s\n' "$out" | grep -c 'the normal of a facet of a curved part')" 3
# shellcheck disable=SC2086
run sweep $tube --az 0:355:5 --el 0 -o curved.csv --brightest 3 --normals smooth
same curved_normals_have_no_such_peaks "$(printf '%s\n' "$out$err" | grep -c 'facet of a curved part\|too coarse')" 0

# ---- materials and files ----
run run demo
same materials_are_told_by_origin "$(printf '%s\n' "$out" | grep -c '^  materials  [0-9]* facets: \(illustrative, of the library: not measured\|as given\)$')" 2
printf 'name = "my lander"\n[[part]]\nname = "p"\nfile = "plate.obj"\nmaterial = "solar-cell"\n' >titled.toml
run run titled.toml --json
same files_are_named_with_their_hashes "$(printf '%s\n' "$out" | grep -c '{"name": "\(titled.toml\|plate.obj\)", "hash": "fnv1a:[0-9a-f]\{16\}", "unit": "m\( assumed\)\?"}')" 2
same a_scene_is_called_by_its_title "$(value title)" '"my lander"'
same a_library_material_is_illustrative "$(printf '%s\n' "$out" | grep -c '"source": "illustrative", "facets": 2}')" 1
same options_are_kept "$(value options)" '["--json"]'
if command -v python3 >/dev/null; then
    same a_hash_is_fnv1a "$(python3 -c '
h = 0xcbf29ce484222325
for b in open("plate.obj", "rb").read(): h = (h ^ b) * 0x100000001b3 % 2**64
print("%016x" % h)')" "$(printf '%s\n' "$out" | sed -n 's/.*plate.obj", "hash": "fnv1a:\([0-9a-f]*\)".*/\1/p')"
else
    skip a_hash_is_fnv1a 'no python3'
fi

# ---- a tolerance that is not in force ----
pair_scene >pair.toml
raster='pair.toml --azel 0,75 --method zbuffer --resolution 16'
# shellcheck disable=SC2086
run run $raster --json
same no_tolerance_no_miss "$rc $(value tolerance) $(value flags)" '0 {"asked": null, "met": null, "accepted_by": null} []'
# shellcheck disable=SC2086
run run $raster
same nor_in_words "$rc $(printf '%s\n' "$out" | grep -ci 'tolerance')" "0 0"
# shellcheck disable=SC2086
run run $raster --tolerance 1e-9
same one_that_is_given_is_in_force "$rc $(printf '%s\n' "$out" | grep -c 'NOT met\|tolerance_not_met')" "3 2"
finish
