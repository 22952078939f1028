#!/bin/sh
# SPDX-License-Identifier: MIT
# Coordinates that are not finite numbers are refused with the file, the line, what was found and what
# was expected; files without coordinates are not a failure.
. "$(dirname "$0")/check.sh"

# obj NUMBER: a triangle with it on line 2.
obj() { printf 'v 0 0 0\nv %s 0 0\nv 0 1 0\nf 1 2 3\n' "$1" >"$scratch/m.obj"; }

for number in nan -nan inf -Inf 1e999; do
    obj "$number"
    failure "obj_$number" "m.obj: line 2: vertex coordinate: found '$number', expected a finite number" \
        run "$scratch/m.obj"
done
for number in 1e308 -1e308 1.1e100; do
    obj "$number"
    failure "obj_$number" "line 2: vertex coordinate: found '$number', expected a magnitude of at most 1e100" \
        run "$scratch/m.obj"
done
obj 1e100
run run "$scratch/m.obj" --json
same largest_coordinate_is_served "$rc" 0
failure largest_coordinate_times_1.5_is_not "at most 1e100 m after placing" run "$scratch/m.obj" --unit 1.5

printf 'solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex nan 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n' >"$scratch/m.stl"
failure stl_nan "line 5: vertex coordinate: found 'nan', expected a finite number" run "$scratch/m.stl"

printf 'schema = 1\n[[part]]\nname = "p"\nshape = "plate"\nsize = [1, inf]\n' >"$scratch/s.toml"
failure toml_inf "line 5" run "$scratch/s.toml"

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >"$scratch/m.obj"
run run "$scratch/m.obj" --json
same mesh_without_facets_is_exit_0 "$rc" 0
same mesh_without_facets_is_nothing "$(value sigma_m2)" 0
same mesh_without_facets_has_no_bound "$(value bound_m2)" 0
finish
