#!/bin/sh
# SPDX-License-Identifier: MIT
# The core, and analysis beside it, built for other machines and run under qemu-user: the core's own tests (on a stand-in for
# cmocka), and the digest, whose hashes must be those of this machine. Machines or compilers that are
# not installed are skipped with a line.
# usage: portable.sh FOLDER TEST...    (in the root; FOLDER holds lrcs.c, and takes what is built)
# from the environment: MACHINES, COMPILERS, LEVELS, FLAGS (the standard), JOBS
folder=$1
shift
MACHINES=${MACHINES:-aarch64 armhf riscv64 s390x}
COMPILERS=${COMPILERS:-gcc clang}
LEVELS=${LEVELS:-0 2 3}
FLAGS=${FLAGS:--std=c11 -pedantic -ffp-contract=off}
JOBS=${JOBS:-$(getconf _NPROCESSORS_ONLN)}
includes='-Itest/portable -Itest -Iinclude -Isrc'
bad=0
ran=0

# machine NAME: its triplet, its qemu, and what clang must be told beside the triplet. On s390x the
# long doubles of the tests' references are to stay in vector registers: qemu 7.2 gets MXDBR wrong.
machine() {
    clang_flags=
    case $1 in
    aarch64) triplet=aarch64-linux-gnu qemu=qemu-aarch64 ;;
    armhf) triplet=arm-linux-gnueabihf qemu=qemu-arm clang_flags=-march=armv7-a+fp ;;
    riscv64) triplet=riscv64-linux-gnu qemu=qemu-riscv64 clang_flags=-march=rv64gc ;;
    s390x) triplet=s390x-linux-gnu qemu=qemu-s390x clang_flags=-march=z14 ;;
    *) echo "portable: no machine $1" >&2; exit 2 ;;
    esac
}

mkdir -p "$folder" || exit 1
# shellcheck disable=SC2086 # flags are words
"${CC:-cc}" $FLAGS -O2 $includes -o "$folder/digest" test/portable/digest.c src/analysis/*.c "$folder/lrcs.c" -lm &&
    "$folder/digest" 1 >"$folder/digest.here" || exit 1

# one MACHINE COMPILER LEVEL TEST...: builds everything, runs it. Called in a folder of its own.
one() {
    machine "$1"
    case $2 in
    gcc) compile="$triplet-gcc" ;;
    clang) compile="clang --target=$triplet $clang_flags" ;;
    esac
    for tool in $triplet-gcc ${compile%% *} $qemu; do
        if ! command -v "$tool" >/dev/null; then
            echo "skip $1 $2 -O$3: no $tool"
            return
        fi
    done
    at=$folder/$1-$2-O$3
    compile="$compile $FLAGS -O$3 -D_XOPEN_SOURCE=700 $includes"
    shift 3
    rm -rf "$at"
    mkdir -p "$at" && $compile -c -o "$at/lrcs.o" "$folder/lrcs.c" || { bad=1; return; }
    for source in src/analysis/*.c; do
        $compile -c -o "$at/analysis_$(basename "$source" .c).o" "$source" || { bad=1; return; }
    done
    for source in test/portable/digest.c "$@"; do
        echo "$source"
    done | AT=$at COMPILE=$compile LINK=$triplet-gcc QEMU=$qemu REFERENCE=$folder/digest.here \
        xargs -n 1 -P "$JOBS" sh -c '
            program=$AT/$(basename "$0" .c)
            case $program in */digest) word="1 $REFERENCE" ;; *) word= ;; esac
            $COMPILE -c -o "$program.o" "$0" && $LINK -static -o "$program" "$program.o" "$AT"/analysis_*.o "$AT/lrcs.o" -lm &&
                echo "exec $QEMU $program $word" >"$program.sh"' || { bad=1; return; }
    sh test/run.sh - "$at"/*.sh >"$at/log" 2>&1 || bad=1
    grep -v '^ok ' "$at/log" | sed "s|^|$at: |"
    ran=$((ran + 1))
}

for name in $MACHINES; do
    for compiler in $COMPILERS; do
        for level in $LEVELS; do
            one "$name" "$compiler" "$level" "$@"
        done
    done
done
echo "portable: $ran builds, $([ $bad -eq 0 ] && echo all the same || echo FAILED)"
exit $bad
