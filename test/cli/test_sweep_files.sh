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
# A whole file is not made again, and its rows decide the exit.
missed='pair.toml --az 0:90:10 --el 75 --method zbuffer --resolution 16 --tolerance 1e-9'
pair_scene >pair.toml
for kind in csv jsonl npy; do
    # shellcheck disable=SC2086
    "$tool" sweep $missed -o missed.$kind 2>/dev/null
    touch -d '2001-01-01' missed.$kind
    # shellcheck disable=SC2086
    run sweep $missed -o missed.$kind --resume
    same "a_whole_${kind}_is_left_alone" "$rc $(find . -name missed.$kind -newermt 2002-01-01)" "3 "
    same "and_its_missed_rows_of_${kind}_are_told" "$(printf '%s\n' "$err" | grep -c '10 of 10 rows miss the tolerance')" 1
done

# A file of another sweep stays: --resume does not replace a complete file.
for shard in 1/2 1/100; do
    cp whole.csv again.csv
    # shellcheck disable=SC2086
    failure "a_whole_sweep_is_no_shard_$(echo $shard | tr / _)" "again.csv: is not a file of this sweep" sweep $what --shard $shard -o again.csv --resume
    equal "and_stays_beside_$(echo $shard | tr / _)" again.csv whole.csv
done
for kind in csv jsonl npy; do
    cp whole.$kind again.$kind
    [ $kind != npy ] || cp whole.npy.head again.npy.head
    failure "a_whole_${kind}_of_another_sweep_stays" "is not a file of this sweep" sweep box.toml --az 0:90:10 --el -20:20:10 --tolerance 1e-2 -o again.$kind --resume
    equal "the_${kind}_is_as_it_was" again.$kind whole.$kind
    printf x | dd of=again.$kind bs=1 seek=900 conv=notrunc 2>/dev/null
    # shellcheck disable=SC2086
    run sweep $what -o again.$kind --resume
    same "a_damaged_${kind}_is_not_taken_for_whole" "$rc $(printf '%s\n' "$err" | grep -c 'is damaged: line .* found .* expected\|differs from its .head')" "1 1"
    same "a_damaged_${kind}_has_one_message" "$(printf '%s\n' "$err" | grep -c '^lrcs: ')" 1
    rm again.$kind
done
cp whole.npy again.npy
rm again.npy.head
# shellcheck disable=SC2086
failure a_map_without_its_head_is_not_known "again.npy: is not a file of this sweep" sweep $what -o again.npy --resume
rm again.npy
same a_map_says_of_which_sweep_it_is "$(sed -n 1,2p whole.npy.head) $(sed -n 3p whole.npy.head | sed 's/=fnv1a:[0-9a-f]*;/=H;/')" "$(sed -n 1,2p whole.csv) # map=H; missed=0; starved=0; estimated=0; unjudged=0"

# ---- damaged rows ----
# damage NAME SED TEXT: row 8 changed so is not continued, and the message says why.
damage() {
    head -20 whole.csv | sed "$2" >again.csv.partial
    # shellcheck disable=SC2086
    failure "$1" "again.csv.partial: is damaged: line 11, $3" sweep $what -o again.csv --resume
}
row=$(grep '^8,' whole.csv)
damage an_axis_changed 's/^8,10,10,/8,70,10,/' "az_deg: found '70', expected 10"
damage a_field_missing 's/^\(8,10,10,[^,]*\),[^,]*/\1/' "the row: found '8,10,10,"
damage a_field_too_many 's/^8,/8,8,/' "the row: found '8,8,10,10"
damage sigma_changed 's/^8,10,10,[^,]*/8,10,10,3/' "sigma_dbsm: found '$(printf %s "$row" | cut -d, -f5)', expected 4.77121"
damage a_negative_bound 's/^\(8,10,10,[^,]*,[^,]*\),[^,]*/\1,-1/' "bound_m2: found '-1', expected a number of at least 0"
damage dbsm_that_is_no_number 's/^\(8,10,10,[^,]*\),[^,]*/\1,junk/' "sigma_dbsm: found 'junk', expected a number"
damage no_bound 's/^\(8,10,10,[^,]*,[^,]*\),[^,]*/\1,/' "bound_m2: found '', expected"
damage nan_for_sigma 's/^8,10,10,[^,]*/8,10,10,nan/' "sigma_m2: found 'nan'"
damage glint_changed 's/^\(8,10,10,[^,]*,[^,]*,[^,]*\),[^,]*/\1,7/' "sigma_glint_m2 and sigma_diffuse_m2: found '7'"
damage a_flag_that_is_none 's/^\(8,.*\)$/\1fine/' "flags: found 'fine', expected names of flags"
damage an_index_that_is_none 's/^8,/x8,/' "index: found 'x8'"
{ head -10 whole.csv && sed -n 12,15p whole.csv; } >again.csv.partial
# shellcheck disable=SC2086
failure a_row_lost "line 11: found row 9, expected row 8" sweep $what -o again.csv --resume
{ head -12 whole.jsonl | sed 's/^{"index": 8, "az_deg": 10/{"index": 8, "az_deg": 40/'; } >again.jsonl.partial
# shellcheck disable=SC2086
failure an_axis_changed_in_json "line 10, az_deg: found '40', expected 10" sweep $what -o again.jsonl --resume
sed 's/"bound_m2": /"sigma_m2": /' whole.jsonl | head -12 >again.jsonl.partial
# shellcheck disable=SC2086
failure a_key_changed_in_json "line 2, the row" sweep $what -o again.jsonl --resume
rm again.*partial

# A sweep that was stopped leaves a checksum: no digit of what is above it may change.
# shellcheck disable=SC2086
"$tool" sweep $what --shard 1/2 -o half.csv 2>/dev/null
sed "s/^\(7,.*[^,]*,[^,]*,\)[0-9]\(.[0-9]*e-[0-9]*,[^,]*,[^,]*,\)/\19\2/" half.csv >half.csv.partial
rm half.csv
same the_bound_was_changed "$(diff half.csv.partial whole.csv | grep -c '^[<>] 7,')" 2
# shellcheck disable=SC2086
failure a_changed_bound_is_seen_by_the_checksum "the last line: found '# checksum=" sweep $what --shard 1/2 -o half.csv --resume
rm half.csv.partial

# ---- what is refused ----
rm -f again.csv
# shellcheck disable=SC2086
head -c 800 whole.csv >again.csv.partial && cp again.csv.partial before.csv
# shellcheck disable=SC2086
failure work_of_hours_is_not_overwritten "--resume continues it; or remove it" sweep $what -o again.csv
failure another_sweep_is_not_resumed "belongs to another sweep" sweep box.toml --az 0:90:10 --el -20:20:20 -o again.csv --resume
# shellcheck disable=SC2086
failure another_shard_is_not_resumed "belongs to another sweep" sweep $what -o again.csv --resume --shard 2/2
# shellcheck disable=SC2086
failure nor_a_longer_one "belongs to another sweep" sweep $what -o again.csv --resume --shard 1/25
# shellcheck disable=SC2086
failure nor_another_material "belongs to another sweep" sweep $what -o again.csv --resume --material 0,0.3,0.2,1
equal and_the_rows_are_still_there again.csv.partial before.csv
rm again.csv.partial
# shellcheck disable=SC2086
mkdir folder.csv
# shellcheck disable=SC2086
failure a_folder_is_refused_before_the_work "folder.csv: cannot write: Is a directory" sweep $what -o folder.csv
same and_nothing_was_begun "$(ls -d folder.csv* | tr '\n' ' ')$(ls folder.csv)" "folder.csv "
# shellcheck disable=SC2086
failure a_folder_that_is_not_there "none/x.csv: cannot write: No such file or directory; there is no folder none/" sweep $what -o none/x.csv
# shellcheck disable=SC2086
[ -e /dev/full ] && { "$tool" sweep $what >/dev/full 2>full.txt; same a_full_disk_exits_1 "$?" 1; }

# ---- a real stop ----
# timeout passes signals on, and undoes that the shell ignores SIGINT in the background.
endless='box.toml --az 0:360:0.00001'
lines() { if [ -e "$1" ]; then wc -l <"$1"; else echo 0; fi; }
if command -v timeout >/dev/null; then
    for signal in INT TERM; do
        before=$(lines cut.csv.partial)
        # shellcheck disable=SC2086
        timeout -s KILL 60 "$tool" sweep $endless -o cut.csv --jobs 2 --resume 2>stop.txt &
        first=$!
        while kill -0 $first 2>/dev/null && [ "$(lines cut.csv.partial)" -lt $((before + 2000)) ]; do sleep 0.02; done
        kill -s $signal $first
        wait $first
        same "sig${signal}_says_how_to_go_on" "$(grep -c 'cut.csv.partial holds .* --resume continues with them' stop.txt)" 1
        same "sig${signal}_leaves_no_file" "$([ -e cut.csv ] && echo there)" ""
        rows=$(grep -c '^[0-9]' cut.csv.partial)
        same "sig${signal}_leaves_whole_rows" "$(tail -c 1 cut.csv.partial | od -An -c | tr -d ' ') $(grep -vc '^#\|^index\|^[0-9]*,[^,]*,0,[^,]*,[^,]*,[^,]*,[^,]*,[^,]*,[a-z_]*$' cut.csv.partial)" '\n 0'
        same "sig${signal}_leaves_rows_in_order" "$(grep '^[0-9]' cut.csv.partial | awk -F, '$1 != NR - 1' | wc -l | tr -d ' ') $((rows > before))" "0 1"
    done
    # the rows of two stops are those of one sweep
    last=$(grep '^[0-9]' cut.csv.partial | sed -n 300p | cut -d, -f2)
    "$tool" sweep box.toml --az "0:$last:0.00001" 2>/dev/null | sed '1d;$d' >one.txt
    sed 1d cut.csv.partial | head -n "$(wc -l <one.txt)" >two.txt
    equal stopped_rows_are_the_rows one.txt two.txt
    same and_no_lock "$(ls cut.csv.lock 2>/dev/null)" ""
else
    skip "sigINT_says_how_to_go_on" "no timeout"
fi

# ---- what is replaced, and what is too large ----
cp whole.csv there.csv
# shellcheck disable=SC2086
run sweep $what -o there.csv
same what_is_replaced_is_named "$rc $(printf '%s\n' "$err" | grep -c '^notice: there.csv exists, of a sweep of 50 rows, and is replaced when this sweep is complete')" "0 1"
# shellcheck disable=SC2086
run sweep $what -o there.csv --resume
same nothing_is_replaced_by_resume "$rc $(printf '%s\n' "$err" | grep -c 'replaced\|^wrote') $(printf '%s\n' "$err" | grep -c '^notice: there.csv is complete: no row is computed$')" "0 0 1"
echo hello >there.csv
# shellcheck disable=SC2086
run sweep $what -o there.csv
same so_is_a_file_of_no_sweep "$rc $(printf '%s\n' "$err" | grep -c '^notice: there.csv exists, and is replaced')" "0 1"
huge='box.toml --az 0:360:0.00001 --el -90:90:0.000001' # 6e15 rows
# shellcheck disable=SC2086
failure more_rows_than_the_disk_holds_are_refused "huge.csv: 6480000216000001 rows take at least" sweep $huge -o huge.csv
# shellcheck disable=SC2086
failure more_rows_than_memory_holds_are_not_kept "--plot, --stats and --brightest keep 16 bytes of each" sweep $huge --stats
same nothing_is_left_of_them "$(ls huge.* 2>/dev/null)" ""
if command -v timeout >/dev/null; then
    # shellcheck disable=SC2086
    timeout -s INT 10 "$tool" sweep $huge 2>pace.txt >/dev/null &
    watched=$!
    while kill -0 $watched 2>/dev/null && ! grep -q 'notice: .* rows to go take some' pace.txt; do sleep 0.1; done
    kill -s INT $watched
    wait $watched
    same a_long_sweep_says_how_long "$(grep -c '^notice: [0-9]* rows to go take some [0-9]* years at the rate of the first seconds$' pace.txt)" 1
fi

# ---- two at once ----
# The second process says who holds the file, and the first one's rows are as if it had been alone.
long='box.toml --az 0:360:0.01'
for kind in csv jsonl npy; do
    # shellcheck disable=SC2086
    "$tool" sweep $long -o alone.$kind 2>/dev/null
    # shellcheck disable=SC2086
    "$tool" sweep $long -o two.$kind 2>/dev/null &
    first=$!
    while [ ! -s two.$kind.partial ] && [ ! -e two.$kind ]; do :; done
    for again in --resume ''; do
        # shellcheck disable=SC2086
        run sweep $long -o two.$kind $again
        if [ -e two.$kind ]; then break; fi # it was too late
        same "the_second_${kind}${again}_says_who_holds_it" "$rc $(printf '%s\n' "$err" | grep -c "two.$kind: is being written by process $first on $(uname -n)")" "1 1"
    done
    wait $first
    same "the_first_${kind}_ends_well" "$?" 0
    equal "its_${kind}_is_as_if_alone" two.$kind alone.$kind
done
# A lock that a killed process left behind does not count.
echo 'process 1 on nowhere' >dead.csv.lock
# shellcheck disable=SC2086
run sweep $what -o dead.csv
equal a_dead_lock_locks_nothing dead.csv whole.csv
same and_goes_away "$(ls dead.csv.lock 2>/dev/null)" ""
# Rows that another program has changed do not become the file.
# shellcheck disable=SC2086
"$tool" sweep $endless -o gone.csv 2>gone.txt &
first=$!
while [ ! -s gone.csv.partial ]; do :; done
mv gone.csv.partial moved.csv
kill -TERM $first
wait $first
same a_file_moved_away_is_told "$(grep -c 'was changed or removed by another program' gone.txt)" 1

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
failure a_shard_twice "part.2.csv: holds rows that another file holds too" merge part.*.csv ./part.2.csv -o x.csv
failure a_shard_of_another_sweep "half.1.csv: belongs to another sweep" merge part.1.csv half.1.csv -o x.csv
failure a_shard_of_another_form "part.2.jsonl: belongs to another sweep" merge part.1.csv part.2.jsonl -o x.csv
head -c 400 part.2.csv >torn.csv
failure a_torn_shard "torn.csv: ends without its checksum" merge part.1.csv torn.csv -o x.csv
failure what_is_no_sweep "box.toml: expected rows of lrcs sweep" merge box.toml -o x.csv
failure a_shard_that_is_not_there "none.csv: cannot open" merge none.csv -o x.csv
# ---- damaged shards ----
for change in 's/^8,10,10,/8,70,10,/' 's/^8,10,10,\([^,]*\),[^,]*/8,10,10,\1/' 's/^\(8,10,10,[^,]*,[^,]*\),[^,]*/\1,-1/' 's/^\(8,10,10,[^,]*\),[^,]*/\1,junk/'; do
    sed "$change" whole.csv >torn.csv
    failure "damage_${change}_is_refused" "torn.csv: is damaged: line" merge torn.csv -o x.csv
    failure "damage_${change}_makes_no_map" "torn.csv: is damaged: line" merge torn.csv -o x.npy
done
sed '$d' whole.jsonl >torn.jsonl
failure a_shard_without_a_checksum "torn.jsonl: ends without its checksum" merge torn.jsonl -o x.jsonl
same a_map_of_shards_has_its_head "$(cmp -s joined.npy.head whole.npy.head || head -1 joined.npy.head | grep -c '^{"lrcs": "sweep"')" 1

usage_error a_merge_without_output "-o OUT is missing" merge part.1.csv
usage_error a_merge_without_files "FILE... is missing" merge -o x.csv
usage_error a_merge_into_another_form "the shards are CSV" merge part.1.csv -o x.jsonl
usage_error a_merge_over_a_shard "would overwrite a shard" merge part.*.csv -o part.2.csv
same nothing_was_made "$([ -e x.csv ] && echo there)" ""
finish
