#!/bin/sh
# SPDX-License-Identifier: MIT
# The README's five minutes: its commands, as they stand there, on a model made here and, where they
# are, on two real ones; with coarser sweeps, and with errors of materials, given as it says.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
sed -n '/^## Five minutes/,/^## Commands/p' "$root/README.md" | sed -n '/^```$/,/^```$/p' | grep '^lrcs ' |
    sed 's/--az 0:360:1/--az 0:360:30/; s/--sphere 2000/--sphere 60/; s/ *#.*//' >commands
same the_readme_has_commands "$(wc -l <commands | tr -d ' ')" 10

five_minutes() { # MODEL UNIT: every command in a folder of its own
    name=$(basename "$1")
    mkdir -p "in_$name" && cp "$1" "in_$name/$name"
    failed=
    while read -r line; do
        case $line in
        *report*--explore*) line="$line --map-step 30" ;;
        *report*) line="$line --seconds 1" ;;
        *"info "*) line="$line --unit $2" ;;
        esac
        line=$(printf '%s\n' "$line" | sed "s/mine\\.3ds/$name/; s/--unit mm/--unit $2/")
        (cd "in_$name" && eval "set -- ${line#lrcs }" && "$tool" "$@" >"../out.$name.$1" 2>"../err.$name.$1") ||
            failed="$failed [$line: $(tail -1 "err.$name.$(printf '%s' "${line#lrcs }" | cut -d' ' -f1)")]"
        # what the user edits: the numbers are given, the amplitudes with their errors
        case $line in
        *" scene "*) sed -i '/^assumed/d; s/^A = 1$/A = 1\nA_error = 0.2/; s/^B = 0.25$/B = 0.25\nB_error = 0.05/' "in_$name/mine.toml" ;;
        esac
    done <commands
    same "every_command_of_the_readme_serves_$name" "$failed" ""
    same "and_leaves_its_files_$name" "$(cd "in_$name" && ls -1 | grep -v "^$name$" | tr '\n' ' ')" "all.csv cut.csv cut.svg explore.html mine.html mine.png mine.toml polar.svg range.csv range.svg "
    same "run_has_a_material_uncertainty_$name" "$(grep -c '^materials    +- ' "out.$name.run")" 1
    same "statistics_have_bands_$name" "$(grep -c ';  materials .* m2$' "out.$name.sweep")" 12
    same "curves_are_shaded_$name" "$(grep -c 'shaded: 68 % by the errors of materials' "in_$name/cut.svg")" 1
    same "bins_add_up_to_sigma_of_run_$name" "$(awk -v run="$(sed -n 's/^sigma  *\([^ ]*\) m2.*/\1/p' "out.$name.run")" -v sum="$(sed -n 's/^sigma  *\([^ ]*\) m2.*/\1/p' "out.$name.profile")" 'BEGIN { d = run - sum; print (run > 0 && d * d < 1e-18 * run * run) }')" 1
    "$tool" plot "in_$name/range.csv" -o again.svg 2>/dev/null
    same "the_profile_is_drawn_again_$name" "$(cmp "in_$name/range.svg" again.svg && echo same)" same
}
{
    printf 'mtllib mine.mtl\nusemtl body\n'
    for v in '0 0 0' '1000 0 0' '1000 800 0' '0 800 0' '0 0 600' '1000 0 600' '1000 800 600' '0 800 600'; do echo "v $v"; done
    printf 'f %s\n' '1 4 3 2' '5 6 7 8' '1 2 6 5' '2 3 7 6' '3 4 8 7' '4 1 5 8'
    printf 'usemtl panel\nv 1200 -500 300\nv 2500 -500 300\nv 2500 1300 300\nv 1200 1300 300\nf 9 10 11 12\nf 12 11 10 9\n'
} >box.obj
five_minutes "$scratch/box.obj" mm
for model in aura.3ds:in kepler.obj:m; do
    if [ -e "$models/${model%:*}" ]; then
        five_minutes "$models/${model%:*}" "${model#*:}"
    else
        skip "the_five_minutes_with_$model" "$models is not there"
    fi
done
finish
