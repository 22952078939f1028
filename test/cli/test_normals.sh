#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run --normals and what lrcs info says of curved parts.
# usage: test_normals.sh TOOL
. "$(dirname "$0")/check.sh"

# A tube of 12 sides, by vertex normals; the same without normals.
awk 'BEGIN {
    for (z = -1; z <= 1; z += 2) for (k = 0; k < 12; k++) {
        a = k * 3.14159265358979 / 6
        printf "v %.12f %.12f %d\nvn %.12f %.12f 0\n", cos(a), sin(a), z, cos(a), sin(a)
    }
    for (k = 1; k <= 12; k++) {
        n = k % 12 + 1
        printf "f %d//%d %d//%d %d//%d %d//%d\n", k, k, n, n, n + 12, n, k + 12, k
    }
}' >"$scratch/tube.obj"
sed '/^vn/d; s,//[0-9]*,,g' "$scratch/tube.obj" >"$scratch/bare.obj"

value() { printf '%s\n' "$out" | sed -n "s/^  \"$1\": \(.*[^,]\),\{0,1\}\$/\1/p"; }

run run "$scratch/tube.obj" --direction 1,0.1,0 --material 1,0.25,0.05,0.5 --json
same flat_is_the_default "$(value normals) $(value curvature_estimate_m2)" '"flat" null'
flat=$(value sigma_m2)
run run "$scratch/bare.obj" --direction 1,0.1,0 --material 1,0.25,0.05,0.5 --json --normals smooth
same without_data_smooth_is_flat "$(value normals) $(value sigma_m2) $(value curvature_estimate_m2)" "\"smooth\" $flat null"
run run "$scratch/tube.obj" --direction 1,0.1,0 --material 1,0.25,0.05,0.5 --json --normals smooth
smooth=$(value sigma_m2)
same smooth_is_another_sigma "$(awk "BEGIN { print ($smooth > 1.1 * $flat || $smooth < 0.9 * $flat) }")" 1
same its_cubature_has_an_estimate "$(value curvature_estimate_m2 | grep -c '^[0-9]')" 1
same the_effect_is_on "$(printf '%s\n' "$out" | grep -c '"curved_normals", "on": true')" 1
run run "$scratch/tube.obj" --direction 1,0.1,0 --material 1,0.25,0.05,0.5 --json --normals=auto
same auto_is_as_smooth_where_all_turn_too_far "$(value normals) $(value sigma_m2)" "\"auto\" $smooth"
run run "$scratch/tube.obj" --direction 1,0.1,0 --material 0,0.25,0.05,0.5 --json --normals auto
same auto_leaves_a_diffuse_tube_flat "$(value curvature_estimate_m2)" null
run run "$scratch/tube.obj" --direction 1,0.1,0 --material 1,0.25,0.05,0.5 --normals smooth
same the_table_calls_it_an_estimate "$(printf '%s\n' "$out" | grep -c '^curvature .* m2   cubature, an estimate, not in the bound$')" 1
same the_table_tells_the_normals "$(printf '%s\n' "$out" | grep -c '^simulated    normals smooth$')" 1
run run "$scratch/tube.obj" --direction 1,0.1,0 --material 1,0.25,0.05,0.5
same flat_has_no_such_line "$(printf '%s\n' "$out" | grep -c '^curvature')" 0
usage_error another_kind_is_refused "--normals: expected flat, auto or smooth, found 'round'" run demo --normals round

run info "$scratch/tube.obj" --material 1,0.25,0.05,0.5
same info_sees_the_turn_of_vertex_normals "$(printf '%s\n' "$out" | grep -c '^  tube.obj .* 30 .*!')" 1
same info_names_the_remedy "$(printf '%s\n' "$out" | grep -c 'too coarse .*lrcs run --normals auto curves them')" 1
run info "$scratch/bare.obj"
same info_says_where_nothing_is_known "$(printf '%s\n' "$out" | grep -c 'no smoothing groups or vertex normals: whether')" 1

finish
