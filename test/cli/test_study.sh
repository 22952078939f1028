#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/study: its numbers against test/vectors/study.csv (40 digits, from Eq. 2 itself), its laws,
# its files, and that examples/study/results is what it writes.
. "$(dirname "$0")/check.sh"
kept=$root/examples/study/results
tool=$(dirname "$tool")/examples/study/study
cd "$scratch" || exit 1

run -o one
table=$out
same all_laws_hold_and_exit_is_0 "$rc $(printf '%s\n' "$out" | tail -1 | cut -d' ' -f1-5)" "0 18 of 18 laws hold"
same table_has_a_line_for_every_law "$(printf '%s\n' "$out" | grep -cE ' holds +[0-9]+ ')" 18
same nothing_on_stderr "$err" ""
run
same without_a_folder_it_prints_the_same "$out" "$table"
same and_writes_nothing "$(ls)" one
run -o two
same the_same_bytes_every_time "$(diff -r one two && echo same)" same
same no_temporary_file_stays "$(find . -name '.lrcs*' | wc -l | tr -d ' ')" 0

# ---- numbers ----
# Each line of the vectors: a cell of a table, its value, the relative error allowed.
judged=$(awk -F, 'function key(row) { return row ~ /^[0-9]/ ? sprintf("%.9g", row) : row }
    function load(file,   line, cell, n, i) {
        while ((getline line < ("one/" file ".csv")) > 0) {
            n = split(line, cell, ",")
            for (i = 2; i <= n; i++) {
                if (!(file in rows)) head[file, i] = cell[i]
                else table[file, key(cell[1]), head[file, i]] = cell[i]
            }
            rows[file]++
        }
    }
    !($1 in rows) { load($1) }
    {
        n++
        row = key($2)
        if (!(($1, row, $3) in table)) { print "missing", $1, $2, $3; next }
        off = table[$1, row, $3] - $4
        if (!(off * off <= $5 * $5 * $4 * $4)) print $1, $2, $3, table[$1, row, $3], "not", $4
    }
    END { print n + 0 }' "$root/test/vectors/study.csv")
same tables_agree_with_40_digits_of_eq_2 "$judged" 262
same no_cell_is_not_a_number "$(grep -ciE 'nan|inf' one/*.csv | grep -cv ':0$')" 0
same last_columns_are_bounds "$(for file in one/*.csv; do head -1 "$file" | sed 's/.*,//'; done | sort | uniq -c | awk '{ print $2, $1 }' | tr '\n' ' ')" "bound 1 bound_deg 2 bound_m2 16 error_estimate_m2 2 "
same rows_have_all_columns "$(for file in one/*.csv; do awk -F, 'NR == 1 { n = NF } NF != n' "$file"; done)" ""

# Kept output: the same files, the same words, numbers to 1e-12 (bounds, in the last column, aside).
same kept_files_are_those_written "$(ls "$kept")" "$(ls one)"
far=$(for file in "$kept"/*.csv; do
    paste -d, "$file" "one/$(basename "$file")" | awk -F, -v file="$(basename "$file")" '{
        for (i = 1; i < NF / 2; i++) {
            a = $i
            b = $(i + NF / 2)
            number = a ~ /^[-0-9]/ && b ~ /^[-0-9]/
            if (a != b && !(number && (a - b) ^ 2 <= 1e-24 * a * a)) print file, NR, a, b
        }
    }'
done)
same kept_numbers_are_those_computed "$far" ""
words() { sed 's/[-+]*[0-9][0-9.e+-]*/#/g' "$1"; }
same kept_page_says_the_same "$(words "$kept/study.md" | cksum)" "$(words one/study.md | cksum)"

# ---- the page ----
same every_picture_is_there "$(sed -n 's/^!\[.*\](\(.*\))$/\1/p' one/study.md | sort)" "$(cd one && ls ./*.svg | cut -c3-)"
same every_table_is_named "$(grep -oE '\]\([a-zA-Z-]+\.csv\)' one/study.md | tr -d '()]' | sort)" "$(cd one && ls ./*.csv | cut -c3-)"
same pictures_are_svg "$(for file in one/*.svg; do sed -n 2p "$file" | cut -c1-4; done | sort -u)" "<svg"
same every_law_has_its_range_and_support "$(grep -c '^### ' one/study.md) $(grep -c '^\*Range:\*' one/study.md) $(grep -c '^\*Support:\*' one/study.md)" "18 18 18"

# ---- laws that the numbers do not support ----
# With m = 0 the diffuse cylinder and cone of the study are equal along the axis; with A < B there
# is no angle up to which the glint is the larger.
run --material 1,2,0.2,0 -o three
same exit_is_1 "$rc" 1
same laws_not_supported "$(printf '%s\n' "$out" | grep 'not supported' | cut -c1-24 | sed 's/ *$//' | tr '\n' ';')" "where diffuse takes over;order along the axis;"
same the_page_says_so_too "$(grep -c '^### .*: not supported$' three/study.md)" 2
run --material 2,0.1,0.1,1
same another_material_keeps_the_laws "$rc" 0

# ---- what cannot be ----
usage_error no_glint "expected A > 0, B > 0, s from 0.02 to 0.5 and m up to 100, found A = 0" --material 0,0.25,0.2,1
usage_error slope_too_large "found A = 1, B = 0.25, s = 0.6" --material 1,0.25,0.6,1
usage_error exponent_too_large "m = 101" --material 1,0.25,0.2,101
usage_error unknown_material "expected A,B,s,m or a library material, found 'gold'" --material gold
usage_error standard_output_is_no_folder "-o: expected a folder, found '-'" -o -
usage_error no_operand "found 'demo'" demo
usage_error an_option_has_a_value "expected a value after '-o'" -o
: >file
failure a_file_is_no_folder "-o file: cannot make the folder" -o file
failure no_folder_in_a_folder_that_is_not_there "-o no/where: cannot make the folder" -o no/where
finish
