#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/flight: on this machine, and on an emulated Cortex-M7 where compiler and emulator are.
. "$(dirname "$0")/common.sh"

flags='-std=c11 -pedantic -ffp-contract=off -Wall -Wextra -Wconversion -Werror'
at=examples/flight

# ---- this machine ----
# shellcheck disable=SC2086 # flags are words
"${CC:-cc}" $flags -O1 -Iinclude -o "$scratch/task" $at/task.c $at/main.c $at/board_host.c $library -lm
same the_task_builds_here "$?" 0
here=$("$scratch/task")
same the_task_says_what_it_promises "$(echo "$here" | sed 's/ = [0-9a-f]*//g; s/ memory .*//')" \
    "$(sed -n '/^\/\* expected output/,/^\*\/$/p' $at/main.c | sed '1d;$d')"

# Cycles with a limit of few steps still return an answer, and flag it.
# shellcheck disable=SC2086
"${CC:-cc}" $flags -O1 -DFLIGHT_STEPS=2000u -Iinclude -o "$scratch/brief" $at/task.c $at/main.c $at/board_host.c \
    $library -lm
brief=$("$scratch/brief")
same few_steps_are_flagged_in_every_good_cycle "$(echo "$brief" | grep -c 'status 0 stale 0 flags 9 steps [12]\?[0-9]\{1,3\} ')" 6
same and_fail_none "$(echo "$brief" | grep -c '^end: status 0 failures 2 ')" 1

cat >"$scratch/misuse.c" <<'END'
#include "task.h"
#include <math.h>
#include <stdio.h>
static void cycle(void)
{
    const double attitude[4] = {1, 0, 0, 0};
    flight_telemetry t;
    flight_cycle(attitude, &t);
    printf("%d %u %.0f ", (int)t.status, (unsigned)t.stale, t.bound_m2);
}
int main(void)
{
    cycle();
    int started = flight_start();
    cycle();
    printf("%d\n", started);
    return 0;
}
END
# misused NAME BYTES WANT: cycles before flight_start, and after one that lacked memory.
misused() {
    # shellcheck disable=SC2086
    "${CC:-cc}" $flags -DFLIGHT_MEMORY="$2" -I$at -Iinclude -o "$scratch/misuse" "$scratch/misuse.c" $at/task.c \
        $library -lm
    same "$1" "$("$scratch/misuse")" "$3"
}
misused no_cycle_answers_before_start 524288u "-10 1 inf 0 0 0 0"
for bytes in 1 4096 8192 20480 40960 131072; do
    misused "no_cycle_answers_after_a_start_in_${bytes}_bytes" ${bytes}u "-10 1 inf -10 1 inf -2"
done

# ---- Cortex-M7 ----
needs the_task_flies_on_a_cortex_m7 arm-none-eabi-gcc qemu-system-arm
m7='-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard'
# Without start files and stubs of system calls: linking would fail if a heap or stdio were used.
# shellcheck disable=SC2086
join_core "$scratch" &&
    arm-none-eabi-gcc $m7 $flags -O0 -ffunction-sections -c -o "$scratch/lrcs.o" "$scratch/lrcs.c" &&
    arm-none-eabi-gcc $m7 $flags -O2 -Iinclude -nostartfiles -T $at/board_m7.ld -Wl,--gc-sections \
        -o "$scratch/task.elf" $at/task.c $at/main.c $at/board_m7.c "$scratch/lrcs.o" -lm
same it_links_for_a_cortex_m7_without_heap_or_stdio "$?" 0
there=$(timeout 300 qemu-system-arm -M mps2-an500 -nographic -icount shift=0 -semihosting-config enable=on,target=native \
    -kernel "$scratch/task.elf" </dev/null 2>&1)
same it_ends_there_with_success "$?" 0
# words TEXT: its lines but for memory and stack, without the bits of areas.
words() { echo "$1" | sed 's/ = [0-9a-f]*//g; s/ memory .*//'; }
same it_says_the_same_there "$(words "$there")" "$(words "$here")"

# The last bits: newlib's exp, log1p and pow are not glibc's.
most=0
areas() { echo "$1" | grep -o '= [0-9a-f]*' | cut -c3-; }
areas "$here" >"$scratch/here"
areas "$there" >"$scratch/there"
while read -r a b; do
    off=$((0x$a - 0x$b))
    [ $off -ge 0 ] || off=$((-off))
    [ $off -le $most ] || most=$off
done <<END
$(paste -d ' ' "$scratch/here" "$scratch/there")
END
if [ -s "$scratch/here" ] && [ $most -le 64 ]; then
    ok "areas_are_within_64_ulp"
else
    not_ok areas_are_within_64_ulp "off by $most"
fi
# limit NAME WORD MOST: the number after that word of the last line.
limit() {
    got=$(echo "$there" | sed -n "s/^end:.* $2 \([0-9]*\).*/\1/p")
    if [ "${got:-0}" -gt 0 ] && [ "$got" -le "$3" ]; then ok "$1"; else not_ok "$1" "got '$got'"; fi
}

# A stack that overflows reaches addresses without memory, and not the memory of the task.
# shellcheck disable=SC2086
arm-none-eabi-gcc $m7 $flags -O2 -Iinclude -nostartfiles -T $at/board_m7.ld -Wl,--gc-sections,--defsym=STACK=4096 \
    -o "$scratch/short.elf" $at/task.c $at/main.c $at/board_m7.c "$scratch/lrcs.o" -lm
short=$(timeout 60 qemu-system-arm -M mps2-an500 -nographic -semihosting-config enable=on,target=native \
    -kernel "$scratch/short.elf" </dev/null 2>&1)
same a_stack_that_runs_over_faults "$([ $? -ne 0 ] && echo "$short" | grep -c '^cycle')" 0
limit memory_stays_in_the_arena memory 524288
limit the_stack_stays_below_16_kb stack 16384
finish
