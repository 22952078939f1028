#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/oracle in C and shell at work (test_install.sh has the Python one): right answers pass,
# wrong ones do not.
. "$(dirname "$0")/check.sh"

cd "$root" || exit 1
build=$(dirname "$tool")
PATH=$build:$PATH

# ---- C: the same test over a slope that is 1 % off must fail ----
sed 's/brdf->s \* brdf->s/1.02 * brdf->s * brdf->s/' examples/oracle/test_mine.c >"$scratch/wrong.c"
for name in examples/oracle/test_mine.c "$scratch/wrong.c"; do
    # shellcheck disable=SC2086 # flags are words
    "${CC:-cc}" -std=c11 -Iinclude "$name" "$build/liblrcs.a" -lcmocka ${LDLIBS:--lm -pthread} -o "$scratch/$(basename "$name" .c)"
done
export CMOCKA_MESSAGE_OUTPUT=STDOUT
same a_unit_test_of_good_code_passes "$("$scratch/test_mine" 2>&1 | grep -c '  PASSED  ')" 1
same a_unit_test_of_wrong_code_fails "$("$scratch/wrong" 2>&1 | grep -cm1 '  FAILED  .*my_sigma')" 1

# ---- shell ----
printf 'time,x,y,z,sigma_m2\n' >"$scratch/theirs.csv"
"$tool" sweep demo --az 10:80:10 --el 20 2>/dev/null | awk -F, '$1 ~ /^[0-9]+$/ {
    d = atan2(0, -1) / 180; az = $2 * d; el = 20 * d
    printf "%d,%.17g,%.17g,%.17g,%.17g\n", $1, cos(el) * cos(az), cos(el) * sin(az), sin(el), $4 }' >>"$scratch/theirs.csv"
oracle() { sh examples/oracle/oracle.sh demo "$scratch/theirs.csv" "$1" 2>/dev/null; }
said=$(oracle 1e-9)
same the_pipeline_passes_what_agrees "$?: ${said%;*}" "0: 8 of 8 rows agree"
sed -i '5s/,\([^,]*\)$/,9\1/' "$scratch/theirs.csv"
said=$(oracle 1e-2)
same the_pipeline_names_the_row_that_does_not "$?: ${said%, off*}" "1: 7 of 8 rows agree; worst: row 4"
finish
