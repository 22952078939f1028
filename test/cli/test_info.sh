#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs info and lrcs shape: keys and some numbers.
. "$(dirname "$0")/check.sh"

run info demo --json
same info_exits_0 "$rc" 0
same info_keys_in_order "$(keys)" "schema version files unit parts vertices facets area_m2 volume_m3 box_min_m box_max_m closed convex materials defects glint surfaces notices title options "
same defects_keys "$(value defects | grep -cE '^\{"degenerate": [0-9]+, "duplicate": [0-9]+, "opposite_pairs": [0-9]+, "boundary_edges": [0-9]+, "nonmanifold_edges": [0-9]+\}$')" 1
same library_values_are_called_illustrative "$(printf '%s\n' "$out" | grep -c illustrative | sed 's/[1-9][0-9]*/some/')" some
run info demo
same library_values_are_called_illustrative_to_people_too "$(printf '%s\n' "$out" | grep -c illustrative | sed 's/[1-9][0-9]*/some/')" some

cat >"$scratch/box.toml" <<'END'
[[part]]
name = "box"
shape = "box"
size = [1, 2, 4]
END
run info "$scratch/box.toml" --json
same box_counts "$(value parts) $(value facets)" "1 12"
same box_area_and_volume "$(value area_m2) $(value volume_m3)" "28 8"
same box_corners "$(value box_min_m) $(value box_max_m)" "[-0.5, -1, -2] [0.5, 1, 2]"
same box_is_closed_and_convex "$(value closed) $(value convex)" "true true"
same box_has_no_glint_entry "$(value glint)" "[]"
same unbound_facets_are_noticed "$(printf '%s\n' "$out" | grep -c '12 of 12 facets have no material')" 1
same unbound_facets_wear_the_default "$(printf '%s\n' "$out" | grep -c '"brdf": {"A": 1, "B": 0.25, "s": 0.2[0-9]*, "m": 0.5}')" 1

run shape sphere --radius 1 --material 1,0.25,0.2,0.5 --json
same shape_keys_in_order "$(keys)" "schema version sigma_m2 sigma_glint_m2 sigma_diffuse_m2 bound_m2 shape options "
near sphere_spot_value "$(value sigma_m2)" 7.24989628827
run shape plate --size 1,1 --aspect=60 --material=1,0.25,0.2,0.5 --json
near plate_spot_value "$(value sigma_m2)" 0.55536036727
run shape plate --size 1,1 --aspect 90 --json
same plate_at_exactly_90_is_0 "$(value sigma_m2) $(value bound_m2)" "0 0"
same missing_material_is_noticed "$(printf '%s\n' "$err" | grep -c '^notice: no --material')" 1
run shape cone --radius 0.5 --half-angle 15 --parts wall --json --material 1,0.25,0.2,0.5
near cone_spot_value "$(value sigma_m2)" 0.324888321144
run shape disc --radius 1 --material solar-cell --aspect 10
same people_get_dbsm "$(printf '%s\n' "$out" | grep -c dBsm)" 1
same shape_exits_0 "$rc" 0

# A tube of 16 sides, 2 m long, radius 1 m, 2 m above the origin, in millimetres: along y, from
# inside.
awk 'BEGIN {
    for (i = 0; i < 32; i++) {
        t = 2 * atan2(0, -1) * int(i / 2) / 16
        printf "v %.17g %d %.17g\n", 1000 * cos(t), 2000 * (i % 2), 2000 + 1000 * sin(t)
    }
    for (i = 0; i < 32; i += 2) {
        j = (i + 2) % 32
        printf "f %d %d %d %d\n", i + 1, j + 1, j + 2, i + 2
    }
}' >"$scratch/tube.obj"
run info "$scratch/tube.obj" --unit mm --json
tube=$(printf '%s\n' "$out" | grep '"surface": "cylinder"')
same a_tube_is_one_cylinder "$(printf '%s\n' "$out" | grep -c '"surface":')" 1
field() { printf '%s\n' "$tube" | sed "s/.*\"$1\": \([^,}]*\).*/\1/"; }
near its_radius "$(field radius_m)" 1
near its_displacement "$(field displacement_bound_m)" 0.0192147195967696
near its_normals_deviate_by_half_a_turn "$(field normal_angle_bound_deg)" 11.25
same its_facets "$(field facets) $(field first_facet) $(field inside)" "32 0 true"
same its_half_angle_is_null "$(field half_angle_deg) $(field half_angle_tangent)" "null null"
run info "$scratch/tube.obj" --unit mm
same people_see_it_too "$(printf '%s\n' "$out" | grep -cE '^ +cylinder .*radius 1, axis 0,1,0 through 0,1,2, inside$')" 1
same a_coarse_tube_is_marked "$(printf '%s\n' "$out" | grep -cE '^ +cylinder .* 0\.[0-9]+! ')" 1
run info "$scratch/box.toml" --json
same shapes_are_not_searched "$(value surfaces)" "[]"

if [ -d "$models" ]; then
    run info "$models/kepler.obj" --json
    same kepler_counts "$(value parts | sed 's/[0-9]*/n/') $(value facets) $(value closed)" "n 392 true"
    same kepler_finds_its_material_file "$(printf '%s\n' "$out" | grep -c '"#1100B9"')" 1
else
    echo "# $models is not there: its models are not tried"
fi
# A hexagonal prism has faces, whatever its unit: turns of 60 deg are no curved surface.
{
    echo 'mtllib none.mtl'
    for z in 0 3; do printf 'v 1 0 %s\nv 0.5 0.8660254 %s\nv -0.5 0.8660254 %s\nv -1 0 %s\nv -0.5 -0.8660254 %s\nv 0.5 -0.8660254 %s\n' $z $z $z $z $z $z; done
    echo 's 1'
    printf 'f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n'
} >"$scratch/hexagon.obj"
for unit in m mm in; do
    run info "$scratch/hexagon.obj" --unit $unit --json
    same "a_hexagonal_prism_in_${unit}_has_no_curved_part" "$rc $(printf '%s\n' "$out" | grep -c '"turn_estimate_deg"')" "0 0"
done
finish
