#!/bin/sh
# SPDX-License-Identifier: MIT
# How many steps a pose takes (calls of the functions below, counted by gcov), beside how many it
# may take at most. Fails where it takes more.
# usage: operations.sh FOLDER    (in the root; FOLDER holds lrcs.c, and takes what is built)
folder=$1/operations
mkdir -p "$folder" || exit 1
# A facet or edge against an event, a line, a cut or a cell, each in bounded time.
questions='lrcsi_view_box_beside lrcsi_view_box_behind edge_crosses intersection_divides
lrcsi_sample_covers_towards line_nearer lrcsi_intersection_find facet_apart lrcsi_facet_cells_order sides_cover candidate_in_front
lrcsi_division_segment_marked lrcsi_clip_locate lrcsi_cells_facet_order event_slack grid_put'
# A curved facet, a triangle of it, a part of that.
parts='lrcsi_cubature_surface_make lrcsi_cubature_add cell_step'
flags='-std=c11 -ffp-contract=off -O0'
# shellcheck disable=SC2086 # flags are words
cp "$1/lrcs.c" "$1/lrcs.h" "$folder" && (cd "$folder" && gcc $flags --coverage -c lrcs.c) &&
    gcc $flags -Itest/portable -Itest -Iinclude -Isrc -c -o "$folder/main.o" test/flight/operations.c &&
    gcc --coverage -o "$folder/operations" "$folder/main.o" "$folder/lrcs.o" -lm || exit 1
bad=0
for name in $questions $parts; do
    grep -qE "^([a-z].*[ *])?$name\(" "$folder/lrcs.c" || { echo "operations: the core has no function $name"; bad=1; }
done
printf '%-18s %6s %6s %9s %-10s %12s %14s\n' scene facets touch cells steps taken 'at most'
for scene in 'boxes 2' 'boxes 16' 'boxes 64' 'sheets 8' 'sheets 64' 'random 8' 'random 32' 'random 128' \
    'book 16' 'book 256' 'half 2' 'half 16' 'patches 1' 'patches 16' 'razors 1' \
    'sheets 64 1000' 'sheets 64 100000' 'random 128 1000' 'random 128 100000' 'book 256 1000' \
    'book 256 100000' 'half 16 10000'; do
    rm -f "$folder"/*.gcda
    # shellcheck disable=SC2086
    said=$("$folder/operations" $scene | sed -n 1p)
    (cd "$folder" && gcov -b -c lrcs.gcda >/dev/null 2>&1)
    echo "$said" | awk -v scene="$scene" -v questions="$questions" -v parts="$parts" '
        function wanted(kind, list,   count, name, i) {
            count = split(list, name, /[ \n]+/)
            for (i = 1; i <= count; i++) kind_of[name[i]] = kind
        }
        function row(kind, most) {
            if (most > 0)
                printf "%-18s %6d %6d %9d %-10s %12d %14.3g\n", scene, facets, intersections, cells, kind, sum[kind], most
            return most > 0 ? sum[kind] > 0 && sum[kind] <= most : !sum[kind]
        }
        BEGIN { wanted("questions", questions); wanted("parts", parts); }
        FNR == NR { facets = $1; intersections = $2; most_q = $3; most_c = $4; next }
        /^function / && ($2 in kind_of) { sum[kind_of[$2]] += $4 }
        /^function process_(facet_)?cell / { cells += $4 }
        END { exit !(row("questions", most_q) + row("parts", most_c) == 2) }
        ' - "$folder/lrcs.c.gcov" || bad=1
done
# shellcheck disable=SC2086
gcc -std=c11 -ffp-contract=off -O2 -Itest -Iexamples/flight -Iinclude -o "$folder/survey" test/flight/survey.c \
    examples/flight/task.c "$1/lrcs.c" -lm && "$folder/survey" || bad=1
exit $bad
