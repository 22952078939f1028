#!/bin/sh
# SPDX-License-Identifier: MIT
# The tool as the oracle of a pipeline: what another code computed, beside the truth of the same poses.
# Ends with the worst row; exit 1 where any is off by more than REL of sigma and what the truth may be
# wrong itself. THEIRS.csv begins with its header: time,x,y,z,sigma_m2 (s; to the laser, body frame).
# usage: oracle.sh SCENE THEIRS.csv REL
#   sh oracle.sh satellite.toml gpu.csv 1e-3
set -e
truth=$(mktemp)
trap 'rm -f "$truth"' EXIT
lrcs sweep "$1" --poses "$2" >"$truth" || [ $? -eq 3 ] # 3: a bound above the tolerance; it counts below
grep -v '^#' "$truth" | cut -d, -f6,8 | paste -d, - "$2" | awk -F, -v rel="$3" '
NR > 1 {
    off = $7 > $1 ? $7 - $1 : $1 - $7
    limit = rel * $1 + $2
    bad += off > limit
    share = limit > 0 ? off / limit : off > 0 ? 1e300 : 0
    if (NR == 2 || share > worst) { worst = share; row = NR - 1; size = off }
}
END {
    printf "%d of %d rows agree; worst: row %d, off by %.3g m2, %.3g of what is allowed\n",
        NR - 1 - bad, NR - 1, row, size, worst
    exit bad > 0
}'
