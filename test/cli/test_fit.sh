#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs fit: tables of every kind, units, messages about parameters that the readings do not determine,
# files, exit codes.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# brdf A B s m FIRST LAST STEP FACTOR: "angle value" lines by awk, f_r times FACTOR.
brdf() {
    awk -v A="$1" -v B="$2" -v s="$3" -v m="$4" -v a="$5" -v b="$6" -v d="$7" -v k="${8:-1}" 'BEGIN {
        for (t = a; t <= b; t += d) {
            c = cos(t * atan2(0, -1) / 180); u = 1 / (c * c) - 1
            printf "%.17g %.17g\n", t, k * (A / c^6 * exp(-u / s^2) + B * c^m) } }'
}
# parameter NAME KEY: of the JSON in $out.
parameter() { printf '%s\n' "$out" | sed -n "s/^        \"$1\": .*\"$2\": \([^,}]*\)[,}].*/\1/p"; }
# close NAME GOT WANT: to 1e-9 of it
close() {
    if awk -v a="$2" -v b="$3" 'BEGIN { d = a - b; exit !(a != "" && d * d <= 1e-18 * b * b) }'; then
        ok "$1"
    else
        not_ok "$1" "got '$2', want '$3'"
    fi
}
# recovers NAME ARGUMENTS...: the fit gives back A=1, B=0.25, s=0.2, m=0.5 and exit 0
recovers() {
    name=$1
    shift
    run fit "$@" --json
    same "${name}_exits_0" "$rc" 0
    close "${name}_gives_A" "$(parameter A value)" 1
    close "${name}_gives_B" "$(parameter B value)" 0.25
    close "${name}_gives_s" "$(parameter s value)" 0.2
    close "${name}_gives_m" "$(parameter m value)" 0.5
}

# ---- tables of every kind ----
brdf 1 0.25 0.2 0.5 -70 75 5 >blanks.txt
recovers blanks_without_names blanks.txt
{ echo '# a comment'; echo; echo 'angle_deg,brdf'; tr ' ' ',' <blanks.txt; } >named.csv
recovers commas_with_names named.csv
{ printf '\357\273\277"BRDF (1/sr)";"Theta [deg]"\r\n'; awk '{ printf "\"%s\"; %s \r\n", $2, $1 }' blanks.txt; } >excel.csv
recovers semicolons_quotes_and_crlf excel.csv
{ printf 'Sample\tangle\treading\ttemperature\n'; awk '{ printf "a, b\t%s\t%s\t20\n", $1, $2 }' blanks.txt; } >tabs.tsv
recovers tabs_and_a_material tabs.tsv
same column_not_used_is_said "$(printf '%s\n' "$out" | grep -c "column 'temperature' is not used")" 1
same material_has_its_name "$(printf '%s\n' "$out" | grep -c '"material": "a, b"')" 1
{ cat blanks.txt; echo '3 nan'; echo '4 NA'; } >missing.txt
recovers lines_without_a_reading missing.txt
same lines_left_out_are_said "$(printf '%s\n' "$out" | grep -c 'left out: 2, the first is line 31')" 1
awk '{ print $1, $2, 0.01 * $2 }' blanks.txt >sigma.txt
recovers given_errors sigma.txt
same given_errors_have_a_chi_square "$(printf '%s\n' "$out" | grep -c '"reduced_chi2": [0-9]')" 1
{ echo 'angle,brdf,weight'; awk '{ print $1 "," $2 ",4" }' blanks.txt; echo '10,99,0'; } >weight.csv
recovers weights_of_0_leave_out weight.csv
{ cat blanks.txt; echo '20 1.5'; echo '41 0'; } >outliers.txt
recovers outliers outliers.txt
same outliers_are_named_by_line "$(printf '%s\n' "$out" | sed -n 's/.*"outlier_lines": //p')" '[31, 32],'

run fit "$root/examples/foil.csv" --json
same example_has_three_outliers "$(printf '%s\n' "$out" | sed -n 's/.*"outlier_lines": //p')" '[14, 49, 66],'
same example_has_relative_errors "$(printf '%s\n' "$out" | grep -c '"errors": "relative"')" 1
same example_holds_its_material "$(awk -v a="$(parameter A low)" -v b="$(parameter A high)" -v c="$(parameter m low)" \
    -v d="$(parameter m high)" 'BEGIN { print (a < 1 && b > 1 && c < 0.5 && d > 0.5) }')" 1
awk 'NR > 1 { srand(NR); print $1, $2 + 0.01 * (rand() - 0.5) }' blanks.txt >even.txt
run fit even.txt
same errors_that_are_the_same_for_all_are_seen "$(printf '%s\n' "$out" | grep -c 'noise model: the same for all (the likelier one)')" 1
run fit even.txt --noise relative
same errors_are_what_was_asked "$(printf '%s\n' "$out" | grep -c 'noise model: relative (as asked)')" 1

# ---- units ----
brdf 1 0.25 0.2 0.5 -70 75 5 3.20570678937734 >panel.txt # pi / 0.98
recovers readings_against_a_panel panel.txt --panel 0.98
awk '{ printf "%s %.17g\n", $1, $2 * cos($1 * atan2(0, -1) / 180) }' blanks.txt >cosine.txt
recovers readings_that_fall_with_the_cosine cosine.txt --cosine
recovers relative_errors blanks.txt --noise relative

# ---- the table, and its lines to paste ----
run fit named.csv --name 'gold foil'
same table_exits_0 "$rc" 0
same table_says_that_all_is_determined "$(printf '%s\n' "$out" | grep -c '^all four parameters are determined$')" 1
same option_to_paste "$(printf '%s\n' "$out" | grep -e '^--material')" "--material 'gold foil=1,0.25,0.2,0.5'"
{ printf '[[part]]\nname = "p"\nshape = "plate"\nsize = [1, 1]\nmaterial = "gold foil"\n'; printf '%s\n' "$out" | sed -n '/^\[\[material/,$p'; } >scene.toml
run run scene.toml --azel 0,70 --json
near block_to_paste_makes_a_scene "$(value sigma_m2)" 3.27656091132

# ---- what is not determined ----
brdf 0 0.3 1 0.2 0 75 5 | awk '{ srand(NR); print $1, $2 + 0.002 * (rand() - 0.5) }' >lambert.txt
run fit lambert.txt
same no_glint_exits_3 "$rc" 3
same and_says_why "$(printf '%s\n' "$err" | grep -c '^lrcs: .*: the readings leave [1-4] of four parameters undetermined$')" 1
same no_glint_is_said "$(printf '%s\n' "$out" | grep -c '^A may be 0: no glint is needed')" 1
same no_slope_is_said "$(printf '%s\n' "$out" | grep -c '^s not determined: there may be no glint')" 1
same no_glint_in_the_material "$(printf '%s\n' "$out" | grep -e '^--material' | grep -c '=0,0.[0-9+.-]*,0,0.[0-9]*')" 1
run fit lambert.txt --json
same json_exits_3_too "$rc" 3
same json_has_no_limit_for_s "$(parameter s high)" null
same json_names_the_open "$(parameter s determined) $(parameter B determined)" "false true"
same json_keys_in_order "$(keys)" "schema version files unit_per_sr cosine fits notices options "
brdf 1 0.25 0.1 0.5 30 75 1 | awk '{ srand(NR); print $1, $2 + 0.002 * (rand() - 0.5) }' >beyond.txt
run fit beyond.txt
same hidden_glint_is_said "$(printf '%s\n' "$out" | grep -c '^A not determined: a glint narrower .* from 30 to 75 deg')" 1

# ---- several materials ----
{ echo 'angle,brdf,sample'; awk '{ print $1 "," $2 ",white" }' blanks.txt; awk '{ printf "%s,%.17g,bright\n", $1, 2 * $2 }' blanks.txt; } >two.csv
run fit two.csv
same two_materials_two_lines "$(printf '%s\n' "$out" | grep -e '^--material' | tr '\n' ' ')" "--material 'white=1,0.25,0.2,0.5' --material 'bright=2,0.5,0.2,0.5' "
run fit two.csv --name bright --plot b.svg
same one_of_two_is_chosen "$(printf '%s\n' "$out" | grep -ce '^--material')" 1
same chart_names_its_material "$(grep -o 'BRDF of bright' b.svg | head -1)" "BRDF of bright"
usage_error charts_of_two_materials "choose one with --name" fit two.csv --plot t.svg
usage_error material_that_is_not_there "the nearest is 'bright'" fit two.csv --name brigt

# ---- files ----
run fit outliers.txt --plot p.svg --residuals r.svg --plot p.PNG --csv r.csv
same csv_columns "$(head -1 r.csv)" "material,line,angle_deg,value,fitted,residual,standard,outlier"
same csv_has_every_reading "$(sed 1d r.csv | wc -l | tr -d ' ')" "$(wc -l <outliers.txt | tr -d ' ')"
same csv_marks_outliers "$(awk -F, '$8 == 1 { print $2 }' r.csv | tr '\n' ' ')" "31 32 "
same csv_adds_up "$(awk -F, 'NR > 1 && ($5 + $6 - $4)^2 > 1e-30' r.csv)" ""
same plot_shows_what_is_set_aside "$(grep -c '>set aside<' p.svg) $(grep -c '>set aside<' r.svg)" "1 1"
same png_is_one "$(od -An -tx1 -N8 p.PNG | tr -d ' ')" 89504e470d0a1a0a
run fit blanks.txt --csv -
same csv_instead_of_the_table "$(printf '%s\n' "$out" | sed -n '1s/,.*//p;2s/,.*//p' | tr '\n' ' ')" "material blanks "
run fit blanks.txt --plot no/p.svg
same unwritable_plot_exits_1 "$rc" 1
same no_temporary_file_stays "$(find . -name '.lrcs*' | wc -l | tr -d ' ')" 0

# ---- errors name the line, what was found and what was expected ----
refused() { # NAME TEXT LINES...
    printf '%b\n' "$3" >bad.csv
    failure "$1" "$2" fit bad.csv
}
rows='10,1\n20,1\n30,1\n40,1\n50,1'
refused empty_table "bad.csv: contains no readings" '# nothing'
refused names_alone "bad.csv: contains no readings" 'angle,brdf'
refused too_few_readings "bad: found 2 readings, expected 5 or more" '1,1\n2,1'
refused all_readings_zero "no reading is above 0" "$(echo "$rows" | sed 's/,1/,0/g')"
refused value_that_is_no_number "line 6, column 2: found 'x1', expected a reading" "$rows\n60,x1"
refused value_beyond_doubles "line 6, column 2: found '1e999'" "$rows\n60,1e999"
refused angle_of_90 "line 6, column 1: found '90', expected an angle between -90 and 90" "$rows\n90,1"
refused decimal_comma "line 1, column 2: found '0,5', expected a number with a decimal point" '1;0,5'
refused another_number_of_fields "line 6: found 3 fields, expected 2" "$rows\n60,1,1"
refused one_field_in_a_line "line 2: found 1 field, expected 2" '1,1\n2'
refused sigma_of_0 "line 2, column sigma: found '0', expected a standard error above 0" 'angle,brdf,sigma\n1,1,0'
refused weight_below_0 "line 2, column weight: found '-1', expected a weight" 'angle,brdf,weight\n1,1,-1'
refused two_angles "found 'theta_r', expected one column of angles (mono" 'theta_i,theta_r,brdf\n1,1,1'
refused angles_in_radians "found 'theta_rad', expected angles in degrees" 'theta_rad,brdf\n1,1'
refused no_column_of_readings "line 1: no column of readings" 'angle,power\n1,1'
refused no_column_of_angles "line 1: no column of angles" 'brdf,power\n1,1'
refused no_column_of_either "line 1: no column of angles and none of readings: not a table of BRDF readings" 'az_deg,sigma_m2,sigma_dbsm\n1,1,1'
refused two_columns_of_errors "found 'error', expected only one column of its kind" 'angle,brdf,sigma,error\n1,1,1,1'
refused four_columns_without_names "found 4 columns without names" '1,2,3,4'
failure missing_file "none.csv: cannot open" fit none.csv
head -c 3000 /dev/urandom >noise.bin
run fit noise.bin
same any_bytes_are_refused "$rc $out" "1 "

# ---- usage ----
usage_error fit_without_data "DATA.csv is missing" fit
usage_error panel_of_0 "found '0'" fit blanks.txt --panel 0
usage_error panel_in_percent "found '99'" fit blanks.txt --panel 99
usage_error unknown_noise "absolute, relative or auto, found 'gauss'" fit blanks.txt --noise gauss
usage_error noise_beside_given_errors "errors of their own" fit sigma.txt --noise relative
usage_error plot_of_another_kind "expected FILE.svg or FILE.png" fit blanks.txt --plot p.pdf
usage_error residuals_of_another_kind "expected FILE.svg or FILE.png" fit blanks.txt --residuals r
usage_error one_file_for_two "name the same file" fit blanks.txt --plot p.svg --residuals ./p.svg
cp blanks.txt data.svg
usage_error plot_over_the_readings "would overwrite the readings" fit data.svg --plot ./data.svg
usage_error csv_over_the_readings "would overwrite the readings" fit blanks.txt --csv blanks.txt
usage_error csv_and_json_on_stdout "both want standard output" fit blanks.txt --csv - --json
finish
