#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run --time-budget: the options that it prints reproduce its answer, whatever that is; and its
# child process ends with it.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
box_scene >box.toml
pair_scene >pair.toml
box_scene >round.toml
printf '[[part]]\nname = "c"\nshape = "cylinder"\nradius = 0.5\nlength = 1\ntranslate = [0, 0, -4]\n' >>round.toml

# crossing N: N large facets that intersect each other.
crossing() {
    awk -v count="$1" 'BEGIN { n = 1; for (i = 0; i < count; i++) { for (k = 0; k < 3; k++) {
        for (j = 0; j < 3; j++) { n = (n * 1103 + 12345) % 1000003; c[j] = n / 1000003 }
        print "v", c[0], c[1], c[2] } print "f -3 -2 -1" } }'
}
crossing 60 >crossed.obj

# ---- wrong arguments ----
for bad in 0 -5 nan x ''; do
    usage_error "a_budget_of_'${bad}'_is_refused" "--time-budget" run box.toml --time-budget "$bad"
done
usage_error the_method_is_not_for_both_to_choose "leave out --method" run box.toml --time-budget 9 --method exact
usage_error the_raster_is_not_for_both_to_choose "leave out --resolution" run box.toml --time-budget 9 --resolution 64
usage_error the_budget_does_not_explain "leave out --explain" run box.toml --time-budget 9 --explain

# ---- answers, and the same again ----
# numbers: those in which two runs with the same settings agree.
numbers() { printf '%s\n' "$out" | grep -E '"(scene_hash|sigma_m2|sigma_glint_m2|bound_m2|projected_area_m2|method|resolution|facets|direction)":'; }
# again NAME SCENE: the options named by the JSON in $out give the same numbers.
again() {
    same_as=$(printf '%s\n' "$out" | sed -n 's/.*"same_as": "\([^"]*\)".*/\1/p')
    found=$(numbers)
    # shellcheck disable=SC2086 # options are words
    run run "$2" --direction 1,1,1 --json $same_as
    same "$1" "$(numbers)" "$found"
}
for scene in box pair round; do
    for budget in 0.001 1000; do
        run run $scene.toml --direction 1,1,1 --time-budget $budget --json
        same "a_bound_above_sigma_exits_3_of_${scene}_in_$budget" "$rc" "$(awk -v b="$(value bound_m2)" -v s="$(value sigma_m2)" -v t="$(value time_budget | sed 's/.*"spent_ms": //; s/,.*//')" -v a=$budget 'BEGIN { print (b > s || t > a + 20) ? 3 : 0 }')"
        again "a_budget_of_${budget}_on_${scene}_gives_what_it_names" $scene.toml
    done
done

run run box.toml --direction 1,1,1 --time-budget 60000 --json
same it_ends_where_nothing_is_left_to_gain "$rc" 0
same no_tolerance_was_asked_for "$(value tolerance)" '{"asked": null, "met": null, "accepted_by": null}'
run run pair.toml --direction 1,1,1 --json
bound=$(value bound_m2)
run run pair.toml --direction 1,1,1 --time-budget 60000 --json
same the_best_of_plane_facets_is_exact "$(value bound_m2)" "$bound"

# Of a box alone, no shadows is the first setting and clipping the last one, with a larger bound (it
# rounds more): the last answer does not replace a better one.
run run box.toml --direction 1,1,1 --method exact --json
clipped=$(value bound_m2)
run run box.toml --direction 1,1,1 --method facet --json
first=$(value bound_m2)
same the_last_setting_is_the_worse_one "$(awk -v a="$first" -v b="$clipped" 'BEGIN { print a * 1.01 < b }')" 1
run run box.toml --direction 1,1,1 --time-budget 60000 --json
same a_later_worse_answer_replaces_nothing "$(value bound_m2) $(value method)" "$first \"facet\""
# With as much time as is needed, no single setting is better, except for rasters by their rounding.
for scene in pair; do
    run run $scene.toml --direction 1,1,1 --time-budget 60000 --json
    got=$(value bound_m2)
    for setting in '--method facet' '--method exact' '--method zbuffer --resolution 256' '--method zbuffer --resolution 1024' '--tolerance 1e-1' '--tolerance 1e-6'; do
        # shellcheck disable=SC2086 # options are words
        run run $scene.toml --direction 1,1,1 $setting --json
        same "nor_is_${setting#--}_of_$scene" "$(awk -v a="$got" -v b="$(value bound_m2)" 'BEGIN { print a <= 1.001 * b }')" 1
    done
done

# error: of the JSON in $out: its bound, or where that exceeds a tenth of sigma its estimate.
error() { awk -v b="$(value bound_m2)" -v e="$(value estimate_m2)" -v s="$(value sigma_m2)" 'BEGIN { t = 0.1 * s; if (b > t && e != "null" && t + e < b) b = t + e; printf "%.17g", b }'; }
# After any time: the answer is one of the settings of the sequence, and the first one, which is always
# completed, is not better.
crossing 400 >many.obj # so many that rasters of samples alone are drawn
for scene in crossed many; do
    run run $scene.obj --azel 20,30 --method facet --json
    first=$(error)
    for budget in 0.001 20 60 200; do
        run run $scene.obj --azel 20,30 --time-budget $budget --json
        best=$(error)
        same_as=$(printf '%s\n' "$out" | sed -n 's/.*"same_as": "\([^"]*\)".*/\1/p')
        same "no_shadows_are_not_better_than_${budget}_ms_of_$scene" "$(awk -v a="$best" -v b="$first" 'BEGIN { print a <= b }')" 1
        same "what_${budget}_ms_of_${scene}_found_is_in_the_sequence" "$(printf '%s\n' "$same_as" | grep -cE '^--method (facet|exact|zbuffer( --accept estimate)? --resolution (256|512|1024))$')" 1
        # shellcheck disable=SC2086 # options are words
        run run $scene.obj --azel 20,30 $same_as --json
        same "what_${budget}_ms_of_${scene}_found_is_its_answer" "$(error)" "$best"
    done
    # With all the time that is needed, none is better.
    run run $scene.obj --azel 20,30 --time-budget 60000 --json
    best=$(error)
    for setting in '--method facet' '--method exact' '--method zbuffer --resolution 256' '--method zbuffer --resolution 1024' '--method zbuffer --accept estimate --resolution 512'; do
        # shellcheck disable=SC2086 # options are words
        run run $scene.obj --azel 20,30 $setting --json
        same "${setting#--}_of_${scene}_is_not_better_than_all_of_them" "$(awk -v a="$best" -v b="$(error)" 'BEGIN { print a <= b }')" 1
    done
done

# ---- a tolerance beside it ----
run run round.toml --direction 1,1,1 --time-budget 60000 --tolerance 0.01 --json
same a_tolerance_that_is_met_ends_it "$rc $(value tolerance)" '0 {"asked": 0.01, "met": true, "accepted_by": "bound"}'
again and_that_is_what_it_names round.toml
run run pair.toml --direction 1,1,1 --time-budget 60000 --tolerance 1e-300 --json
same a_tolerance_out_of_reach_exits_3 "$rc $(printf '%s' "$out" | grep -c tolerance_not_met)" "3 1"
run run pair.toml --direction 1,1,1 --time-budget 60000
same its_bound_is_said_in_words "$(printf '%s\n' "$out" | grep -cE '^verdict      geometry and shadows are proved to [0-9.e-]+ of sigma')" 1
same no_flag_without_a_tolerance "$(printf '%s\n' "$out" | grep -c '^flag')" 0
same the_table_names_the_options "$(printf '%s\n' "$out" | grep -cE '^time budget  60000 ms, of which [0-9.e+]+ were spent; the same again: --method exact$')" 1

# ---- files come from the settings found ----
run run round.toml --direction 1,1,1 --time-budget 60000 --tolerance 0.01 --facets budget.csv --json
same_as=$(printf '%s\n' "$out" | sed -n 's/.*"same_as": "\([^"]*\)".*/\1/p')
# shellcheck disable=SC2086
run run round.toml --direction 1,1,1 --facets again.csv --json $same_as
same files_are_those_of_the_settings_named "$(cmp budget.csv again.csv && wc -l <budget.csv | tr -d ' ')" "$(wc -l <again.csv | tr -d ' ')"

# ---- open shapes among others, whose facets are recorded, and materials that state errors ----
for budget in 0.001 300; do
    run run demo --azel 30,20 --time-budget $budget --json
    same "open_shapes_of_the_demo_in_$budget" "$((rc == 0 || rc == 3)) $(value bound_m2 | grep -c '[0-9]')" '1 1'
    run run demo --azel 30,20 --time-budget $budget --material 'white=0.02,0.25+-0.01,0.4,0.2' --sensitivity --json
    same "errors_of_materials_in_$budget" "$((rc == 0 || rc == 3)) $(printf '%s\n' "$out" | grep -c '"material_uncertainty": {')" '1 1'
done

# ---- its processes ----
# children PID: its child processes that have not ended.
children() { ps -A -o pid=,ppid=,stat= | awk -v p="$1" '$2 == p && $3 !~ /^Z/ { print $1 }'; }
# Clipping these takes longer than is waited for the end of the process, on any machine.
crossing 3000 >dense.obj
"$tool" run dense.obj --azel 20,30 --time-budget 600000 --json >/dev/null 2>&1 &
started=$!
left=3000
while [ "$(children $started | wc -l)" -lt 1 ] && [ $left -gt 0 ]; do
    sleep 0.1
    left=$((left - 1))
done
all=$(children $started)
same one_sequence_runs_in_one_process "$(printf '%s\n' "$all" | grep -c .)" 1
sleep 1 # by now it clips: the rasters, whose answers nobody reads, would end it too
kill -KILL $started
wait $started 2>/dev/null
left=15
while [ "$(ps -A -o pid=,stat= | awk -v all="$(echo $all)" 'BEGIN { n = split(all, list, " "); for (i = 1; i <= n; i++) is[list[i]] = 1 } is[$1] && $2 !~ /^Z/' | wc -l)" -gt 0 ] && [ $left -gt 0 ]; do
    sleep 0.1
    left=$((left - 1))
done
same none_outlives_the_command "$((left > 0))" 1
failure a_missing_scene_is_said_once "cannot open" run nowhere.toml --time-budget 100
finish
