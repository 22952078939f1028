#!/bin/sh
# SPDX-License-Identifier: MIT
# How many questions a pose asks (calls of the functions below, counted by gcov), beside how many it
# may ask at most. Fails where it asks more.
# usage: operations.sh FOLDER    (in the root; FOLDER holds lrcs.c, and takes what is built)
folder=$1/operations
mkdir -p "$folder" || exit 1
# A facet or edge against an event, a line, a cut or a cell, each in bounded time.
asked='boxes_apart edge_crosses touch_contests box_misses lrcsi_sample_covers_towards line_nearer
touched_by cover_add order_of line_meets line_hidden lrcsi_clip_meets lrcsi_cut_ends lrcsi_clip_within
event_slack grid_put'
flags='-std=c11 -ffp-contract=off -O0'
# shellcheck disable=SC2086 # flags are words
cp "$1/lrcs.c" "$1/lrcs.h" "$folder" && (cd "$folder" && gcc $flags --coverage -c lrcs.c) &&
    gcc $flags -Itest/portable -Itest -Iinclude -Isrc -c -o "$folder/main.o" test/flight/operations.c &&
    gcc --coverage -o "$folder/operations" "$folder/main.o" "$folder/lrcs.o" -lm || exit 1
printf '%-8s %6s %6s %9s %12s %14s\n' scene facets touch cells questions 'at most'
bad=0
for scene in 'boxes 2' 'boxes 16' 'boxes 64' 'sheets 8' 'sheets 64' 'random 8' 'random 32' 'random 128'; do
    rm -f "$folder"/*.gcda
    # shellcheck disable=SC2086
    said=$("$folder/operations" $scene | sed -n 1p)
    (cd "$folder" && gcov -b -c lrcs.gcda >/dev/null 2>&1)
    echo "$said" | awk -v scene="${scene% *}" -v asked="$asked" '
        BEGIN { count = split(asked, list, /[ \n]+/); for (i = 1; i <= count; i++) wanted[list[i]] = 1 }
        FNR == NR { facets = $1; touches = $2; most = $3; next }
        /^function / && ($2 in wanted) { sum += $4 }
        /^function cell_do / { cells = $4 }
        END {
            printf "%-8s %6d %6d %9d %12d %14.3g\n", scene, facets, touches, cells, sum, most
            exit !(sum > 0 && sum <= most)
        }' - "$folder/lrcs.c.gcov" || bad=1
done
exit $bad
