#!/bin/sh
# SPDX-License-Identifier: MIT
# The files of lrcs sweep: what a stop leaves, what --resume makes of it, what lrcs merge joins.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

box_scene >box.toml
what='box.toml --az 0:90:10 --el -20:20:10'

# equal NAME FILE FILE
equal() { if cmp -s "$2" "$3"; then ok "$1"; else not_ok "$1" "$(diff "$2" "$3" | head -4)"; fi; }

# ---- whole files ----
# shellcheck disable=SC2086
for kind in csv jsonl npy; do
    run sweep $what -o whole.$kind
    same "sweep_to_${kind}_is_silent_on_stdout" "$rc $out" "0 "
done
# shellcheck disable=SC2086
"$tool" sweep $what >stdout.csv 2>/dev/null
equal a_file_is_what_stdout_gets whole.csv stdout.csv
# shellcheck disable=SC2086
"$tool" sweep $what --json >stdout.jsonl 2>/dev/null
equal and_so_it_is_for_json_lines whole.jsonl stdout.jsonl
same no_partial_file_stays "$(find . -name '*.partial' | wc -l | tr -d ' ')" 0
same no_terminal_no_bar "$(printf '%s' "$err" | tr -d '\n' | grep -c "$(printf '\r')")" 0

# ---- a stop anywhere ----
size=$(wc -c <whole.csv)
head=$(head -2 whole.csv | wc -c)
for bytes in 0 1 $((head - 1)) "$head" $((head + 1)) $((size / 2)) $((size / 2 + 7)) $((size - 1)) "$size"; do
    for kind in csv jsonl; do
        rm -f again.$kind
        head -c "$bytes" whole.$kind >again.$kind.partial
        # shellcheck disable=SC2086
        run sweep $what -o again.$kind --resume --jobs 3
        equal "resumed_after_${bytes}_bytes_of_${kind}_it_is_the_same" again.$kind whole.$kind
    done
done
cp whole.csv map.npy.partial
# shellcheck disable=SC2086
"$tool" sweep $what -o map.npy --resume 2>/dev/null
equal a_map_resumes_from_its_rows map.npy whole.npy
same and_leaves_none_of_them "$(find . -name '*.partial' | wc -l | tr -d ' ')" 0
# A whole file is not made again: its row with another sigma stays.
sed 's/^3,.*/3,30,-20,7,8.4509804001425675,0.001,tolerance_not_met/' whole.csv >again.csv
cp again.csv before.csv
# shellcheck disable=SC2086
run sweep $what -o again.csv --resume
equal a_whole_file_is_left_alone again.csv before.csv
same its_rows_decide_the_exit "$rc" 3

# What is there but of another sweep gives way, as a file without --resume does.
for shard in 1/2 1/100; do
    cp whole.csv again.csv
    # shellcheck disable=SC2086
    "$tool" sweep $what --shard $shard -o part.csv 2>/dev/null
    # shellcheck disable=SC2086
    run sweep $what --shard $shard -o again.csv --resume
    equal "a_whole_sweep_is_no_shard_$(echo $shard | tr / _)" again.csv part.csv
    rm part.csv
done

# ---- what is refused ----
# shellcheck disable=SC2086
head -c 500 whole.csv >again.csv.partial && cp again.csv.partial before.csv
# shellcheck disable=SC2086
failure work_of_hours_is_not_overwritten "--resume goes on with it; or remove it" sweep $what -o again.csv
failure another_sweep_is_not_resumed "is of another sweep" sweep box.toml --az 0:90:10 --el -20:20:20 -o again.csv --resume
# shellcheck disable=SC2086
failure another_shard_is_not_resumed "is of another sweep" sweep $what -o again.csv --resume --shard 2/2
# shellcheck disable=SC2086
failure nor_a_longer_one "is of another sweep" sweep $what -o again.csv --resume --shard 1/25
# shellcheck disable=SC2086
failure nor_another_material "is of another sweep" sweep $what -o again.csv --resume --material 0,0.3,0.2,1
equal and_the_rows_are_still_there again.csv.partial before.csv
rm again.csv.partial
# shellcheck disable=SC2086
failure a_folder_that_is_not_there "none/x.csv.partial: cannot write" sweep $what -o none/x.csv
# shellcheck disable=SC2086
[ -e /dev/full ] && { "$tool" sweep $what >/dev/full 2>full.txt; same a_full_disk_exits_1 "$?" 1; }

# ---- a real stop ----
endless='box.toml --az 0:360:0.00001'
if command -v timeout >/dev/null; then
    for signal in INT TERM; do
        # shellcheck disable=SC2086
        timeout -s $signal 2 "$tool" sweep $endless -o cut.csv --jobs 2 --resume 2>stop.txt
        same "sig${signal}_says_how_to_go_on" "$(grep -c 'cut.csv.partial holds .* --resume goes on' stop.txt)" 1
        same "sig${signal}_leaves_no_file" "$([ -e cut.csv ] && echo there)" ""
        rows=$(grep -c '^[0-9]' cut.csv.partial)
        same "sig${signal}_leaves_whole_rows" "$(tail -c 1 cut.csv.partial | od -An -c | tr -d ' ') $(grep -vc '^#\|^index\|^[0-9]*,[^,]*,0,[^,]*,[^,]*,[^,]*,[a-z_]*$' cut.csv.partial)" '\n 0'
        same "sig${signal}_leaves_rows_in_order" "$(grep '^[0-9]' cut.csv.partial | awk -F, '$1 != NR - 1' | wc -l | tr -d ' ') $((rows > 0))" "0 1"
    done
    # the rows of two stops are those of one sweep
    last=$(grep '^[0-9]' cut.csv.partial | sed -n 300p | cut -d, -f2)
    "$tool" sweep box.toml --az "0:$last:0.00001" 2>/dev/null | sed 1d >one.txt
    sed 1d cut.csv.partial | head -n "$(wc -l <one.txt)" >two.txt
    equal stopped_rows_are_the_rows one.txt two.txt
else
    skip "sigINT_says_how_to_go_on" "no timeout"
fi

# ---- shards ----
# shellcheck disable=SC2086
for kind in csv jsonl; do
    for k in 1 2 3 4 5 6 7; do
        "$tool" sweep $what --shard $k/7 --jobs $k -o part.$k.$kind 2>/dev/null
    done
    run merge part.7.$kind part.[1-6].$kind -o joined.$kind
    equal "merged_${kind}_is_the_single_run" joined.$kind whole.$kind
    run merge part.*.$kind -o joined.npy
    equal "merged_${kind}_makes_the_map" joined.npy whole.npy
    run merge part.*.$kind -o -
    same "merged_${kind}_on_stdout" "$out" "$(cat whole.$kind)"
done
# shellcheck disable=SC2086
for k in $(seq 60); do
    "$tool" sweep $what --shard "$k/60" -o "thin.$k.csv" 2>/dev/null
done
run merge thin.*.csv -o joined.csv
equal more_shards_than_rows joined.csv whole.csv
run merge whole.csv -o joined.csv
equal a_single_file_stays_the_same joined.csv whole.csv
for kind in csv jsonl; do
    "$tool" sweep box.toml --sphere 50 -o ball.$kind 2>/dev/null
    "$tool" sweep box.toml --sphere 50 --shard 1/2 -o half.1.$kind 2>/dev/null
    "$tool" sweep box.toml --sphere 50 --shard 2/2 -o half.2.$kind 2>/dev/null
    same "a_shard_of_a_sphere_has_no_mean_in_$kind" "$(grep -c mean half.1.$kind)" 0
    run merge half.2.$kind half.1.$kind -o joined.$kind
    equal "merged_${kind}_has_the_mean" joined.$kind ball.$kind
    run merge ball.$kind -o again.$kind
    equal "a_mean_is_not_doubled_in_$kind" again.$kind ball.$kind
done

failure a_shard_missing "row 28 of 50 is in none of the files" merge part.[1-4].csv part.[67].csv -o x.csv
failure a_shard_twice "part.2.csv: holds rows that another file holds" merge part.*.csv ./part.2.csv -o x.csv
failure a_shard_of_another_sweep "half.1.csv: is of another sweep" merge part.1.csv half.1.csv -o x.csv
failure a_shard_of_another_form "part.2.jsonl: is of another sweep" merge part.1.csv part.2.jsonl -o x.csv
head -c 300 part.2.csv >torn.csv
failure a_torn_shard "torn.csv: ends in what is no row" merge part.1.csv torn.csv -o x.csv
failure what_is_no_sweep "box.toml: expected rows of lrcs sweep" merge box.toml -o x.csv
failure a_shard_that_is_not_there "none.csv: cannot open" merge none.csv -o x.csv
usage_error a_merge_without_output "-o OUT is missing" merge part.1.csv
usage_error a_merge_without_files "FILE... is missing" merge -o x.csv
usage_error a_merge_into_another_form "the shards are CSV" merge part.1.csv -o x.jsonl
usage_error a_merge_over_a_shard "would overwrite a shard" merge part.*.csv -o part.2.csv
same nothing_was_made "$([ -e x.csv ] && echo there)" ""
finish
