#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep --stats: mean by solid angle, percentiles, least and most, against the rows themselves.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
box_scene >box.toml
stat() { printf '%s\n' "$1" | sed -n "s/^  $2  *\([0-9.e+-]*\) m2.*/\1/p"; }

# The mean over all directions of a convex body of one material: 22 m2, B = 0.25, m = 0, A = 0:
# 22 2 pi 0.25 / 3 = 11.5191730632.
run sweep box.toml --az 0:360:3 --el -90:90:3 --material 0,0.25,0.2,0 -o grid.csv --stats
same a_grid_is_weighed_by_solid_angle "$(awk -v a="$(stat "$out" mean)" 'BEGIN { d = a / 11.5191730632 - 1; print (a != "" && d * d < 1e-6) }')" 1
plain=$(grep '^[0-9]' grid.csv | awk -F, '{ s += $4 } END { d = s / NR / 11.5191730632 - 1; print (d * d < 1e-6) }')
same a_plain_mean_would_not_do "$plain" 0
same least_and_most_have_their_attitudes "$(printf '%s\n' "$out" | grep -c '^  \(least\|most\) .* at az_deg = [0-9.-]*, el_deg = [0-9.-]*$')" 2
run sweep box.toml --sphere 500 -o ball.csv --stats
near the_mean_of_a_sphere_is_that_of_its_rows "$(awk -v a="$(stat "$out" mean)" -v b="$(sed -n 's/^# mean_sigma_m2=\([^;]*\);.*/\1/p' ball.csv)" 'BEGIN { d = a / b - 1; print (d * d < 1e-16) }')" 1
sorted() { grep '^[0-9]' ball.csv | cut -d, -f5 | sort -g | sed -n "$1p"; }
for part in least:1 '5 %:25' '50 %:250' '99 %:495' most:500; do
    same "${part%:*}_is_row_${part#*:}_of_500" "$(awk -v a="$(stat "$out" "${part%:*}")" -v b="$(sorted "${part#*:}")" 'BEGIN { d = a / b - 1; print (d * d < 1e-16) }')" 1
done
run sweep box.toml --az 0:90:10 --stats
same without_a_file_stdout_is_for_rows "$(printf '%s\n' "$out" | grep -c statistics) $(printf '%s\n' "$err" | grep -c '^statistics   10 rows')" "0 1"
usage_error of_a_shard_nothing_is_known "--stats is of whole sweeps" sweep box.toml --az 0:90:10 --shard 1/2 --stats
finish
