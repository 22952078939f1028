#!/bin/sh
# SPDX-License-Identifier: MIT
# Lines and branches of the core that the tests run, as gcov counts them: a table by file and the
# total on stdout, branches never taken with their lines in BUILD/untaken.txt.
# usage: coverage.sh BUILD    (in the root; BUILD was compiled with --coverage, and its tests ran)
build=$1
counted=$(find "$build"/src/base "$build"/src/mesh "$build"/src/optics "$build"/src/scene \
    "$build"/src/view "$build"/src/visibility "$build"/src/integrate -name '*.gcda' | LC_ALL=C sort)
[ -n "$counted" ] || { echo "coverage: nothing has run in $build" >&2; exit 1; }

# shellcheck disable=SC2086
gcov -b -n $counted 2>/dev/null | awk '
    /^File / { file = $2; gsub("\047", "", file); ours = file ~ /^src\/[a-z]+\/[a-z0-9_]+\.[ch]$/ }
    /^(Lines executed|Taken at least once):/ && ours {
        share = $0
        gsub(/^[^:]*:|%.*/, "", share)
        of = $NF
        done = int(share * of / 100 + 0.5)
        if (/^Lines/) { lines[file] = of; ran[file] = done; all_lines += of; all_ran += done }
        else { branches[file] = of; taken[file] = done; all_branches += of; all_taken += done }
    }
    /^(Calls executed|No calls)/ { ours = 0 }
    END {
        order = "LC_ALL=C sort"
        for (file in lines)
            printf "%-34s %6d %6d %8d %6d\n", file, lines[file], lines[file] - ran[file], \
                branches[file], branches[file] - taken[file] | order
        close(order)
        if (all_lines == 0) exit 1
        printf "%-34s %6d %6d %8d %6d\n", "the core", all_lines, all_lines - all_ran, all_branches, \
            all_branches - all_taken
        printf "lines %.2f %%, branches %.2f %%\n", 100 * all_ran / all_lines, \
            100 * all_taken / all_branches
    }' >"$build/coverage.txt" || exit 1
printf '%-34s %6s %6s %8s %6s\n' file lines 'not run' branches 'not taken'
cat "$build/coverage.txt"

# shellcheck disable=SC2086
gcov -b -c -t $counted 2>/dev/null | awk '
    /^ *-: *0:Source:/ { file = $0; sub(/^.*Source:/, "", file) }
    /^ *[0-9#=*-]+\*?: *[0-9]+:/ {
        number = $0; sub(/^[^:]*: */, "", number); sub(/:.*/, "", number)
        text = $0; sub(/^[^:]*:[^:]*:/, "", text); told = 0
    }
    /^branch .* (never executed|taken 0)/ && file ~ /^src\// && !told++ {
        print file ":" number ":" text
    }' | LC_ALL=C sort -t : -k 1,1 -k 2,2n | uniq >"$build/untaken.txt"
echo "branches never taken: $build/untaken.txt"
