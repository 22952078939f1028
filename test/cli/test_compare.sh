#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs compare, tested with answers whose mistakes are known: those of a raster code (examples/kit) that
# is right, or has one deliberate mistake; and tables made from the truth.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
${CC:-cc} -O2 -std=c11 -Wall -Wextra -Werror -ffp-contract=off -o raster "$root/examples/kit/raster.c" -lm ||
    not_ok the_raster_code_compiles
"$tool" vectors kit --tier 3 --resolution 96 >/dev/null
"$tool" vectors whole --resolution 64 >/dev/null

# why NAME EXIT WORDS: the last verdict has this exit status, and its text these words.
why() {
    found=$(printf '%s\n' "$out" | grep -ac -- "$3")
    same "$1" "$rc $found" "$2 1"
}

# judged KIT MISTAKE OPTIONS...: what the raster code answers, judged.
judged() {
    kit=$1
    shift
    ./raster "$kit" 96 "$1" >theirs.csv
    shift
    run compare "$kit" theirs.csv --pixels 96 --tier 5 "$@"
}

run compare whole whole/cases.csv --class exact
why the_truth_is_exact 0 '^verdict      passed'
same and_needs_no_reasons "$(printf '%s\n' "$out" | grep -cE '^(why|unexplained)')" 0
judged whole none
why a_raster_code_that_is_right_passes_every_tier 0 '^verdict      passed'
same tier_by_tier "$(printf '%s\n' "$out" | grep -cE '^tier [1-5]       passed')" 5
./raster kit 0 >theirs.csv
run compare kit theirs.csv --tier 2 --class exact
why a_sum_over_facets_is_exact_for_convex_bodies 0 '^verdict      passed'
run compare kit theirs.csv
why cases_that_are_missing_fail 1 '^tier 3       FAILED, 77 of 77 cases'

# named MISTAKE WORDS: the raster code with a mistake fails, and the first reason is that one.
named() {
    judged kit "$1"
    why "${1}_is_named" 1 "^why          $2"
    same "${1}_is_the_one_reason" "$(printf '%s\n' "$out" | grep -cE '^(why|unexplained)')" 1
}
named shadows 'missing shadows'
named backs 'back faces: visible backs of one-sided facets reflect'
named hand 'wrong handedness: x mirrored'
named mirror 'wrong handedness: y mirrored, which turns the winding as well$'
named winding 'winding: fronts are taken for backs'
named frame 'wrong frame: R in place of its transpose'
named degrees 'degrees for radians: theta in degrees'
named radians 'degrees for radians: azimuth and elevation'
named 4pi '0.0795775 times the truth everywhere: 4 pi is missing'
named cos 'missing cos: a sum of f_r'
named pixel '.*1.02.* pixel area: N - 1'
named colour 'colour quantisation: f_r cos in 8 bits, 1 being'
named glint 'under-resolved glint: theta rounded to 5 deg'
named shadows+cos 'missing shadows.*; and missing cos'
named hand+4pi 'wrong handedness: x mirrored; and 0.0795775 times that: 4 pi is missing'
# reason MISTAKE WORDS: the same, where some cases are left for other reasons: rounding, ties.
reason() {
    judged kit "$1"
    why "${1}_is_named" 1 "^why          $2"
}
reason farthest 'inverted depth: the farthest facet is seen'
reason tan 'degrees for radians: theta in degrees goes into tan'
./raster kit 96 winding >theirs.csv
run compare kit theirs.csv --pixels 96 --tier 1
why what_explains_as_well_is_named_too 1 '^why          winding: .*; or, equally well: wrong frame: the laser on the other side'
./raster kit 96 frame | awk -F, -v OFS=, '$1 == "comb" { $3 *= 0.7 } { print }' >theirs.csv
run compare kit theirs.csv --pixels 96
why what_the_window_cuts_off_is_told 1 '^why          wrong frame: R in place of its transpose.*; in [0-9]* cases less than that: part of the scene is outside'
judged whole depth
why depth_is_named 1 '^why          depth precision: surfaces 2^-14 m apart'
judged whole fight
why facets_in_one_plane_are_named 1 '^why          coincident surfaces, decided by rounding or by order (z-fighting)'
same and_are_the_one_reason "$(printf '%s\n' "$out" | grep -cE '^(why|unexplained)')" 1
./raster kit 64 >theirs.csv
run compare kit theirs.csv
why a_coarser_raster_is_named 1 '^why          a raster of fewer than 512 x 512 pixels: all these pass as one of [0-9]* x [0-9]* or fewer: give --pixels N'
same and_explains_all "$(printf '%s\n' "$out" | grep -c '^unexplained')" 0
awk -F, -v OFS=, 'NR == 1 { print "scene,attitude,sigma_m2"; next } { print $1, $2, ($1 == "comb" && $2 == "f" ? 0.3853 : $13) }' kit/cases.csv >theirs.csv
run compare kit theirs.csv
why one_facet_in_the_plane_of_another_too 1 '^why          coincident surfaces, decided by rounding'
./raster kit 0 float >theirs.csv
run compare kit theirs.csv --tier 2 --class exact
why float_is_named 1 '^why          single precision'
run compare kit theirs.csv --tier 2 --class float
why float_is_enough_where_it_is_asked 0 '^verdict      passed'

# Tables of facets and images of items.
mkdir images
./raster kit 96 items=images >theirs.csv
mkdir mixed && cp images/box.a.item.u32 mixed && cp images/box.a.item.u32 mixed/comb.a.item.u32
run compare kit theirs.csv --pixels 96 --items images
why images_that_are_right_agree 0 '16 of 16 images found; 0 differ'
for file in images/*.u32; do # rows of 384 bytes, the last one first
    i=96
    while [ $i -gt 0 ]; do
        i=$((i - 1))
        dd if="$file" bs=384 skip=$i count=1 2>/dev/null
    done >flipped && mv flipped "$file"
    case $file in */box.*) break ;; esac
done
run compare kit theirs.csv --pixels 96 --items images
why images_upside_down_are_told 0 '  2 are upside down'
head -c 100 images/box.a.item.u32 >short && mv short images/box.a.item.u32
run compare kit theirs.csv --pixels 96 --items images
same an_image_cut_short_is_refused "$rc $(printf '%s\n' "$err" | grep -c 'expected 96 x 96 pixels of 4 bytes, found 100 bytes')" "1 1"

# Tables made from the truth's.
truth() { awk -F, -v OFS=, 'NR == 1 { print "scene,attitude,sigma_m2"; next } { print $1, $2, '"$1"' }' kit/cases.csv; }
truth '$16' >theirs.csv
run compare kit theirs.csv
why a_missing_glint_is_named 1 '^why          BRDF: the glint term is missing'
truth '$13 * 3.7' >theirs.csv
run compare kit theirs.csv
why any_factor_is_named 1 '^why          3.7 times the truth everywhere'
truth 'NR % 2 ? $13 * (1 + NR % 7) : $13 / (2 + NR % 5)' >theirs.csv
run compare kit theirs.csv
why what_nothing_explains_is_unexplained 1 '^unexplained  [0-9]* failing cases$'
why with_numbers 1 '^             plate-white nose: 1.571 m2, truth 6.283 (0.25 of it), allowed 0.0'
truth '$1 == "comb" && $2 == "f" ? 3 : $13' >theirs.csv
run compare kit theirs.csv
why one_case_is_no_cases 1 '^unexplained  1 failing case$'
truth 0 >theirs.csv
run compare kit theirs.csv
why nothing_but_zeros_is_told 1 '^why          every answer is 0: nothing drawn'
same and_needs_no_other_reason "$(printf '%s\n' "$out" | grep -cE '^(why|unexplained)')" 1

# read_as NAME WORDS TABLE...: what a table holds if it is not what its columns say.
read_as() {
    name=$1
    words=$2
    shift 2
    "$@" >theirs.csv
    run compare kit theirs.csv
    why "$name" 1 "^why          $words"
    same "${name}_and_that_is_all" "$(printf '%s\n' "$out" | grep -c '^why')" 1
}
decibels() { awk -F, -v OFS=, 'NR == 1 { print "scene,attitude,'"$2"'"; next }
    { print $1, $2, ($13 > 0 ? sprintf("%.12g", '"$1"' * log($13) / log(10)) : "-inf") }' kit/cases.csv; }
read_as dbsm_in_place_of_m2 'the column sigma_m2 holds dBsm' decibels 10 sigma_m2
read_as twenty_logarithms 'decibels: 20 log10 in place of 10 log10' decibels 20 sigma_dbsm
read_as m2_in_place_of_dbsm 'the column sigma_dbsm holds m2' awk -F, -v OFS=, 'NR == 1 { $13 = "sigma_dbsm" }
    { print $1, $2, $13 }' kit/cases.csv
read_as two_digits_are_too_few 'few digits: every answer is rounded to 2 digits' truth 'sprintf("%.2g", $13)'
read_as rows_that_moved 'rows: every answer is one line too late' awk -F, -v OFS=, '
    NR == 1 { print "scene,attitude,sigma_m2"; next } { print $1, $2, (NR == 2 ? 6 : last); last = $13 }' kit/cases.csv
truth '$1 == "box" ? "nan" : $13' >theirs.csv
run compare kit theirs.csv --json -
same nan_fails "$rc $(printf '%s\n' "$out" | grep -c '"class": "fail", "passed": false')" "1 14"
run compare kit theirs.csv
why nan_is_told 1 '^why          14 answers are not numbers: box nose, box a, '
truth '$1 == "box" && $2 == "a" ? -1 : $13' >theirs.csv
run compare kit theirs.csv
why a_negative_answer_is_told 1 '^why          1 answer is negative: box a$'
same and_is_not_told_twice "$(printf '%s\n' "$out" | grep -c '^unexplained')" 0
grep -v '^box,[ab],' kit/cases.csv >theirs.csv
run compare kit theirs.csv
why missing_cases_are_named 1 '^missing      2 cases: box a, box b$'
awk -F, -v OFS=';' 'NR == 1 { print "Sigma_dBsm", "extra", "ATTITUDE", "scene"; next }
    { print ($13 > 0 ? sprintf("%.15g", 10 * log($13) / log(10)) : "-inf"), "x", $2, $1 }' kit/cases.csv >theirs.csv
run compare kit theirs.csv
why dbsm_in_columns_of_any_order 0 '^verdict      passed'

cat kit/truth/*.facets.csv | awk -F, -v OFS=, 'NR == 1 || $1 != "scene" {
    if ($1 == "wings" && $2 == "a" && $3 == 4) $5 = 0
    if ($1 == "box" && $2 == "b") next
    print }' >facets.csv
run compare kit kit/cases.csv --facets facets.csv
why a_facet_that_they_lost_is_told 0 '  1 facet not seen by them'
why and_which_one_it_is 0 '  wings a, facet 4 (metal): 0 m2, in truth 0.157895 m2'
why and_how_many_cases_there_were 0 '^facets       of 189 cases'
if command -v python3 >/dev/null; then
    run compare kit kit/cases.csv --facets facets.csv --items mixed --json all.json
    same facets_and_images_are_told_as_json_too "$rc $(python3 -c '
import json
told = json.load(open("all.json"))
facets, items = told["facets"], told["items"]
worst = facets["worst"][0]
print(facets["cases"], facets["differ"][0]["text"][:16], facets["differ"][0]["count"], facets["cos_theta"],
      worst["scene"], worst["attitude"], worst["facet"], worst["theirs_m2"], "%.6f" % worst["visible_area_m2"])
print(items["asked"], items["given"], items["differ"], [(w["text"][:15], w["count"]) for w in items["ways"]],
      items["worst"][0]["scene"], items["worst"][0]["lost"][0]["pixels"] > 100)')" "0 189 not seen by them 1 double precision wings a 4 0 0.157895
16 2 1 [('agree with the ', 1)] comb True"
fi

# areas CONDITION AREA: facets of box a and b whose areas are other ones.
areas() {
    cat kit/truth/box.facets.csv | awk -F, -v OFS=, 'NR == 1 { print; next }
        ($2 == "a" || $2 == "b") && $5 > 0 { if ('"$1"') $5 = '"$2"'; print }' >facets.csv
}
areas 1 '$5 + 0.08'
run compare kit kit/cases.csv --facets facets.csv --pixels 96
why pixels_along_outlines_are_no_difference 0 '^facets       of 2 cases: none differs'
run compare kit kit/cases.csv --facets facets.csv --pixels 4096
why but_areas_too_large_are_one 0 '  12 facets seen larger by them than they are'
areas '$2 == "a"' '0.5 * $5'
run compare kit kit/cases.csv --facets facets.csv
why a_facet_that_is_whole_in_truth_misses_no_shadow 0 '  6 facets seen in part by them, whole in truth'
same and_none_is_called_so "$(printf '%s\n' "$out" | grep -c 'missing shadow')" 0
areas 1 '($2 == "a" ? 0.2 : 0.7) * $5'
truth '$1 == "box" && $2 == "b" ? 0.7 * $13 : $13' >theirs.csv
run compare kit theirs.csv --facets facets.csv
same facets_of_cases_that_fail_come_first "$(printf '%s\n' "$out" | grep -a 'facet [0-9]* (' | head -6 | cut -c14-18 | sort | uniq -c | tr -s ' ')" " 6 box b"

run compare kit kit/cases.csv --junit unit.xml --json all.json
same files_do_not_change_the_verdict "$rc" 0
run compare kit kit/cases.csv --junit -
same junit_in_place_of_the_table "$rc $(printf '%s\n' "$out" | grep -vc '^<')" "0 0"
if command -v python3 >/dev/null; then
    truth '$13 * ($2 == "a" ? 3 : 1)' >theirs.csv
    "$tool" compare kit theirs.csv --junit unit.xml --json all.json >/dev/null
    same junit_and_json_agree "$(python3 -c '
import json, xml.etree.ElementTree as tree
x, j = tree.parse("unit.xml").getroot(), json.load(open("all.json"))
failed = [(c["scene"], c["attitude"]) for c in j["cases"] if not c["passed"]]
told = [(c.get("classname"), c.get("name")) for c in x.iter("testcase") if c.find("failure") is not None]
print(failed == told, len(failed) == j["failed"] == int(x.get("failures")) > 0,
      len(j["cases"]) == int(x.get("tests")) == sum(int(s.get("tests")) for s in x))')" "True True True"
fi

# Files that are not tables of answers.
refused() {
    printf '%b' "$3" >theirs.csv
    failure "$1" "$2" compare kit theirs.csv
}
refused an_empty_table 'theirs.csv: expected a line that names the columns' ''
refused a_table_without_sigma 'line 1: no column is named sigma_m2 or sigma_dbsm' 'scene,attitude\nbox,a\n'
refused a_table_without_scenes 'line 1: no column is named scene; expected a line of column names, found attitude, sigma_m2' 'attitude,sigma_m2\n'
refused a_number_that_is_none "line 3, column sigma_m2: found '1,5x', expected a number with a decimal point" 'scene;attitude;sigma_m2\nbox;a;1\nbox;b;1,5x\n'
refused a_line_that_is_short 'line 2: found 2 fields, expected 3 as in the first line' 'scene,attitude,sigma_m2\nbox,a\n'
refused a_line_that_is_long 'found 4' 'scene,attitude,sigma_m2\nbox,a,1,2\n'
refused a_scene_of_another_kit "line 2, column scene: found 'boxx', expected a scene of the kit, which has tiers 1 .. 3 (the nearest is box)" 'scene,attitude,sigma_m2\nboxx,a,1\n'
refused an_attitude_of_another_scene 'expected an attitude of box' 'scene,attitude,sigma_m2\nbox,t05,1\n'
refused a_case_given_twice "line 3, column attitude: found 'a', expected every case once" 'scene,attitude,sigma_m2\nbox,a,1\nbox,a,1\n'
refused a_name_that_is_a_path "expected a name of a-z" 'scene,attitude,sigma_m2\n../box,a,1\n'
refused bytes_that_are_no_text "found '\\x01\\xff', expected a number" 'scene,attitude,sigma_m2\nbox,a,\0001\0377\n'
refused a_name_without_end 'expected a name of 1 .. 31 bytes' "scene,attitude,sigma_m2\n$(printf 'x%.0s' $(seq 300)),a,1\n"
failure a_table_that_is_not_there 'none.csv' compare kit none.csv
failure a_folder_that_is_no_kit "images: not the folder of a kit (lrcs vectors DIR makes one)" compare images theirs.csv
failure a_folder_of_images_that_is_not_there 'nodir: cannot open folder' compare kit kit/cases.csv --items nodir
./raster kit 96 shadow >raster.out 2>&1
same the_raster_code_refuses_what_it_cannot_do "$? $(grep -c 'no mistake of mine is called shadow; these are: none shadows' raster.out)" "2 1"
echo 'scene,attitude,facet,visible_area_m2
box,a,12,1' >facets.csv
run compare kit kit/cases.csv --facets facets.csv
same a_facet_beyond_the_last "$rc $err" "1 lrcs: facets.csv: line 2, column facet: found '12', expected a facet 0 .. 11"
cp -r kit broken
sed 's/^box,a,2,[^,]*/box,a,2,x/' kit/cases.csv >broken/cases.csv
failure a_kit_that_was_damaged "column qw: found 'x', expected a number" compare broken kit/cases.csv

usage_error two_names_are_asked_for "found 1 operand" compare kit
usage_error and_not_three "found 3 operands" compare kit a b
usage_error a_class_of_its_own "expected exact, float or raster, found 'good'" compare kit kit/cases.csv --class good
usage_error answers_are_not_overwritten "would overwrite what is to be judged" compare kit theirs.csv --json theirs.csv
usage_error one_file_for_two_outputs "name the same file" compare kit theirs.csv --json x --junit x
finish
