#!/bin/sh
# SPDX-License-Identifier: MIT
# The satellites of examples/satellites: each runs as it stands, its joints turn, nothing is left out.
. "$(dirname "$0")/check.sh"

for scene in "$root"/examples/satellites/*.toml; do
    name=$(basename "$scene" .toml)
    run run "$scene" --azel 40,25 --tolerance 0.1 --json
    same "${name}_runs" "$(printf '%s' "$rc" | tr 3 0)" 0
    same "${name}_has_a_return" "$(value sigma_m2 | awk '{ print ($1 > 0) }')" 1
    same "${name}_is_bounded_below_its_size" "$(awk -v s="$(value sigma_m2)" -v b="$(value bound_m2)" 'BEGIN { print (b < s) }')" 1
    sigma=$(value sigma_m2)
    sed 's/^angle_deg = .*/angle_deg = 3/' "$scene" >"$scratch/turned.toml"
    run run "$scratch/turned.toml" --azel 40,25 --tolerance 0.1 --json
    same "${name}_has_joints_that_turn" "$([ "$(value sigma_m2)" != "$sigma" ] && echo turned)" turned
    run info "$scene" --json
    same "${name}_has_no_defects" "$(printf '%s\n' "$out" | grep -c '"degenerate": 0, "duplicate": 0')" 1
done
finish
