#!/bin/sh
# SPDX-License-Identifier: MIT
# --accept: what must meet the tolerance, and that every output says what was accepted unproved.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
# 14 layers of 40 slanting slats over a plate: many borders of shadows
awk 'BEGIN {
    print "v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3 4"
    for (i = 0; i < 560; i++) {
        l = int(i / 40); x = -2.6 + 0.13 * (i % 40) + 0.05 * l; z = 1 + 0.02 * (i % 40) + 0.2 * l; k = 5 + 4 * i
        printf "v %g -2 %g\nv %g -1.98 %g\nv %g 2.1 %g\nv %g 2 %g\nf %d %d %d %d\n", x, z, x + 0.07, z + 0.03, x + 0.2, z, x + 0.12, z - 0.02, k, k + 1, k + 2, k + 3
    }
}' >slats.obj
laser='--direction 1,2,5'

usage_error what_is_accepted_has_three_names "--accept: expected bound, estimate or any, found 'guess'" run slats.obj --accept guess
usage_error a_time_budget_proves "leave out --accept" run slats.obj --time-budget 9 --accept any
usage_error emulated_hardware_is_judged_by_a_bound "--accept" run slats.obj --precision float32 --accept estimate

# ---- run ----
# tolerance: that of the JSON in $out.
tolerance() { value tolerance; }
# shellcheck disable=SC2086
run run slats.obj $laser --tolerance 1e-2 --json
same without_it_a_proof_counts "$rc $(tolerance) $(value flags)" '0 {"asked": 0.01, "met": true, "accepted_by": "bound"} []'
proved=$out
# shellcheck disable=SC2086
run run slats.obj $laser --tolerance 1e-2 --accept bound --json
same which_is_the_default "$(printf '%s\n' "$out" | grep -v 'seconds\|options')" "$(printf '%s\n' "$proved" | grep -v 'seconds\|options')"
sigma=$(value sigma_m2)
# shellcheck disable=SC2086
run run slats.obj $laser --tolerance 1e-2 --accept estimate --json
same an_estimate_meets_and_says_so "$rc $(tolerance) $(value flags)" '0 {"asked": 0.01, "met": true, "accepted_by": "estimate"} ["accepted_by_estimate"]'
same it_is_a_raster "$(value method)" '"zbuffer"'
size=$(value resolution)
estimated=$(value sigma_m2)
same its_bound_stays_the_proved_one "$(awk -v a="$estimated" -v c="$sigma" -v b="$(value bound_m2)" -v e="$(value estimate_m2)" \
    'BEGIN { print (a - c <= b && c - a <= b && b > 0.01 * a && e <= 0.01 * a) }')" 1
# shellcheck disable=SC2086
run run slats.obj $laser --tolerance 1e-2 --accept estimate
same the_table_says_it "$(printf '%s\n' "$out" | grep -c 'tolerance 0.01 met by the ESTIMATE alone$\|^flag         accepted_by_estimate$')" 2
# shellcheck disable=SC2086
run run slats.obj $laser --method zbuffer --resolution "$size" --accept estimate --json
same it_is_the_raster_that_can_be_asked_for "$rc $(value sigma_m2) $(tolerance)" "0 $estimated {\"asked\": null, \"met\": null, \"accepted_by\": null}"
# shellcheck disable=SC2086
run run slats.obj $laser --method zbuffer --resolution "$size" --tolerance 1e-2
same which_misses_where_a_proof_is_asked "$rc" 3
# shellcheck disable=SC2086
run run slats.obj $laser --method zbuffer --resolution "$size" --tolerance 1e-2 --accept estimate
same and_meets_where_none_is "$rc" 0
# shellcheck disable=SC2086
run run slats.obj $laser --tolerance 1e-6 --accept estimate --json
same what_no_estimate_meets_is_proved "$rc $(value method) $(tolerance)" '0 "exact" {"asked": 9.9999999999999995e-07, "met": true, "accepted_by": "bound"}'
# shellcheck disable=SC2086
run run slats.obj $laser --method facet --tolerance 1e-2 --accept any --json
same any_misses_no_tolerance "$rc $(tolerance) $(value flags)" '0 {"asked": 0.01, "met": null, "accepted_by": "any"} ["accepted_unjudged"]'
# shellcheck disable=SC2086
run run slats.obj $laser --method facet --tolerance 1e-2 --accept any
same and_the_table_says_that_none_was_judged "$rc $(printf '%s\n' "$out" | grep -c 'not judged: any answer was accepted$')" "0 1"

# ---- image ----
# shellcheck disable=SC2086
run image slats.obj $laser --tolerance 1e-2 --accept estimate -o picture.png --size 64
same a_picture_comes_with_a_notice "$rc $(printf '%s\n' "$err" | grep -c 'met by the estimate alone')" "0 1"
# shellcheck disable=SC2086
run image slats.obj $laser --tolerance 1e-2 -o picture.png --size 64
same and_without_one_where_it_is_proved "$rc $(printf '%s\n' "$err" | grep -c 'estimate')" "0 0"

# ---- sweep ----
what='slats.obj --az 0:90:15 --el 40:80:20 --tolerance 1e-2'
for kind in csv jsonl npy; do
    # shellcheck disable=SC2086
    run sweep $what --accept estimate -o map.$kind
    same "estimates_are_no_missed_rows_of_$kind" "$rc $(printf '%s\n' "$err" | grep -c 'rows are accepted by estimate, not proved to 0.01$')" "0 1"
done
# shellcheck disable=SC2086
"$tool" sweep $what -o plain.csv 2>/dev/null
# shellcheck disable=SC2086
"$tool" sweep $what -o plain.npy 2>/dev/null
same the_head_says_what_was_accepted "$(head -1 map.csv | grep -c '; accept=estimate; ') $(head -1 map.jsonl | grep -c '"accept": "estimate"') $(grep -c accept plain.csv)" "1 1 0"
same every_row_is_flagged_where_its_bound_misses "$(awk -F, '/^[0-9]/ && ($6 > 1e-2 * $4) != ($9 == "accepted_by_estimate") { bad++ } /^[0-9]/ && $9 != "" { n++ } END { print bad + 0, (n > 5) }' map.csv)" "0 1"
same json_lines_say_the_same "$(grep -c '"flags": \["accepted_by_estimate"\]' map.jsonl)" "$(grep -c ',accepted_by_estimate$' map.csv)"
for k in 1 2 3; do
    # shellcheck disable=SC2086
    "$tool" sweep $what --accept estimate --shard $k/3 -o part.$k.csv 2>/dev/null
done
run merge part.1.csv part.2.csv part.3.csv -o merged.csv
same shards_join "$rc $(cmp merged.csv map.csv && echo same)" "0 same"
run merge part.1.csv part.2.csv part.3.csv -o merged.npy
same and_so_do_maps "$rc $(cmp merged.npy map.npy && echo same)" "0 same"
head -5 map.csv >again.csv.partial
# shellcheck disable=SC2086
run sweep $what --accept estimate -o again.csv --resume
same flagged_rows_are_resumed "$rc $(cmp again.csv map.csv && echo same)" "0 same"
# shellcheck disable=SC2086
run sweep $what --accept any --method facet -o any.csv
same rows_that_are_not_judged_are_flagged_too "$rc $(grep -c ',accepted_unjudged$' any.csv)" "0 $(awk -F, '/^[0-9]/ && $6 > 1e-2 * $4 { n++ } END { print n + 0 }' any.csv)"
# shellcheck disable=SC2086
"$tool" sweep $what --accept estimate -o cut.csv --plot cut.svg 2>/dev/null
same a_plot_says_it "$(grep -c 'accepted by estimate' cut.svg)" 1
if command -v python3 >/dev/null; then
    python3 -B - <<'END' >npy.txt
import struct
def load(path):
    data = open(path, "rb").read()
    size = struct.unpack("<H", data[8:10])[0]
    shape = eval(data[10:10 + size].decode())["shape"]
    return shape, struct.unpack("<%dd" % ((len(data) - 10 - size) // 8), data[10 + size:])
shape, flat = load("map.npy")
rows = [l.rstrip("\n").split(",") for l in open("map.csv") if l[0] != "#"][1:]
good = all(tuple(flat[3 * i:3 * i + 3]) == (float(r[3]), float(r[5]), float(r[8] == "accepted_by_estimate")) for i, r in enumerate(rows))
print(shape, len(flat) == 3 * len(rows), good, load("plain.npy")[0])
END
    same a_map_holds_the_verdicts "$(cat npy.txt)" "(7, 3, 3) True True (7, 3, 2)"
fi

# ---- report ----
# shellcheck disable=SC2086
run report slats.obj $laser --tolerance 1e-2 --accept estimate -o page.html --seconds 1 --cut-step 45 --map-step 45
same a_report_is_done "$rc" 0
same it_says_that_an_estimate_meets "$(grep -c 'is met by the likely error, <b>an estimate</b>, alone' page.html)" 1
same its_commands_accept_the_same "$(grep -cE '^lrcs (run|image|sweep) .*--accept estimate' page.html)" 7
finish
