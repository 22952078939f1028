#!/bin/sh
# SPDX-License-Identifier: MIT
# Lines and branches of the core that the tests run, as gcov counts them: a table by file and the
# total on stdout; branches never taken with their functions and lines in BUILD/untaken.txt. The
# functions are compared with those of test/coverage.md, which says why: it fails if either names one
# that the other does not.
# With folders of src: a table of these instead, and BUILD/untaken.txt; nothing is compared.
# usage: coverage.sh BUILD [FOLDER...]    (in the root; BUILD was compiled with --coverage, and its
# tests ran)
build=$1
shift
folders=${*:-base mesh optics scene view visibility integrate}
# shellcheck disable=SC2086
counted=$(for folder in $folders; do
    find "$build/src/$folder" "$build/test/$folder" -name '*.gcda' 2>/dev/null
done | LC_ALL=C sort)
[ -n "$counted" ] || { echo "coverage: nothing has run in $build" >&2; exit 1; }

# What a header holds is compiled many times, in tests too: a branch counts as taken where it was in
# any.
# shellcheck disable=SC2086
gcov -b -c -t $counted 2>/dev/null | awk -v untaken="$build/untaken.txt" -v folders=" $folders " '
    /^ *-: *0:Source:/ {
        file = folder = $0
        sub(/^.*Source:/, "", file)
        sub(/^.*Source:src\//, "", folder)
        sub(/\/.*/, "", folder)
        ours = file ~ /^src\// && index(folders, " " folder " ")
    }
    ours && /^ *[0-9#=*-]+\*?: *[0-9]+:/ {
        count = number = text = $0
        sub(/:.*/, "", count)
        sub(/^[^:]*: */, "", number)
        sub(/:.*/, "", number)
        sub(/^[^:]*:[^:]*: */, "", text)
        place = file ":" number
        name = $0
        sub(/^[^:]*:[^:]*:/, "", name)
        if (name ~ /^[a-z][^;]*\(/) { # the head of a function starts its line
            sub(/\(.*/, "", name)
            sub(/.*[ *]/, "", name)
            within[file] = name
        }
        label[place] = within[file] ": " text
        if (count !~ /-/) ran[place] += count ~ /[0-9]/
    }
    ours && /^branch / { taken[place, $2] += / taken [1-9]/ }
    END {
        for (place in ran) {
            file = place
            sub(/:.*/, "", file)
            lines[file]++
            unrun[file] += !ran[place]
        }
        for (branch in taken) {
            split(branch, part, SUBSEP)
            file = part[1]
            sub(/:.*/, "", file)
            branches[file]++
            missed[file] += !taken[branch]
            if (!taken[branch]) spared[part[1]]
        }
        sorted = "LC_ALL=C sort -t : -k 1,1 -k 2,2n >" untaken
        for (place in spared) print place ":" label[place] | sorted
        close(sorted)
        form = "%-34s %6s %8s %9s %10s\n"
        printf form, "file", "lines", "not run", "branches", "not taken"
        order = "LC_ALL=C sort"
        for (file in lines) {
            printf form, file, lines[file], unrun[file], branches[file] + 0, missed[file] + 0 | order
            sum[1] += lines[file]
            sum[2] += unrun[file]
            sum[3] += branches[file]
            sum[4] += missed[file]
        }
        close(order)
        printf form, "together", sum[1], sum[2], sum[3], sum[4]
        printf "lines %.2f %%, branches %.2f %%\n", 100 - 100 * sum[2] / sum[1], \
            100 - 100 * sum[4] / sum[3]
    }' || exit 1
[ $# -eq 0 ] || exit 0

cut -d: -f1,3 "$build/untaken.txt" | sed 's/:/: /' | LC_ALL=C sort -u >"$build/untaken"
sed -n 's/^    src/src/p' test/coverage.md | LC_ALL=C sort >"$build/listed"
LC_ALL=C comm -23 "$build/untaken" "$build/listed" |
    sed "s|^|a branch is never taken, and test/coverage.md does not say why: |"
LC_ALL=C comm -13 "$build/untaken" "$build/listed" |
    sed 's/^/listed in test\/coverage.md, but every branch is taken: /'
cmp -s "$build/untaken" "$build/listed"
