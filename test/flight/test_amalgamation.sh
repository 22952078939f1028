#!/bin/sh
# SPDX-License-Identifier: MIT
# The core as two files: they compile alone without a warning, a program links with nothing else, and
# their call graph has no recursion.
. "$(dirname "$0")/common.sh"

join_core "$scratch/joined"
same the_core_joins_into_two_files "$?: $(ls "$scratch/joined")" "0: lrcs.c
lrcs.h"
strict='-std=c11 -pedantic -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion -Werror'
graph=
"${CC:-cc}" -fcallgraph-info=su -x c -c -o "$scratch/none.o" /dev/null 2>/dev/null && graph=-fcallgraph-info=su
# shellcheck disable=SC2086 # flags are words
said=$("${CC:-cc}" $strict -O0 $graph -c -o "$scratch/lrcs.o" "$scratch/joined/lrcs.c" 2>&1)
same they_compile_alone_without_a_warning "$?: $said" "0: "
if command -v clang >/dev/null; then
    # shellcheck disable=SC2086
    said=$(clang $strict -fsyntax-only "$scratch/joined/lrcs.c" 2>&1)
    same clang_has_no_warning_either "$?: $said" "0: "
fi

# ---- the stack ----
if [ -n "$graph" ]; then
    said=$(sh test/stack.sh "$scratch/lrcs.ci" 2>&1)
    same the_core_has_no_recursion "$(echo "$said" | sed -n '1s/.* functions, //p')" \
        "no recursion, no calls through pointers, every frame known"
    bytes=$(echo "$said" | sed -n 's/^stack: at most \([0-9]*\) bytes.*/\1/p')
    same it_takes_less_than_16_kb_of_stack_for_any_scene "$((${bytes:-16384} < 16384)): $bytes" "1: $bytes"
    # refused NAME CODE REASON: what the graph of that C code is refused for.
    refused() {
        echo "$2" >"$scratch/bad.c"
        "${CC:-cc}" -O0 $graph -c -o "$scratch/bad.o" "$scratch/bad.c"
        same "$1" "$(sh test/stack.sh "$scratch/bad.ci" 2>&1 || echo "refused")" "stack: $3
refused"
    }
    refused recursion_is_found 'int g(int); int f(int x) { return x ? g(x - 1) + 1 : 0; } int g(int x) { return 2 * f(x); }' \
        'recursion through f'
    refused a_function_that_calls_itself_is_found 'int f(int x) { return x ? f(x - 1) : 0; }' 'recursion through f'
    refused a_call_through_a_pointer_is_found 'int f(int (*p)(int)) { return p(1) + 1; }' 'f calls through a pointer'
    refused an_array_of_any_length_is_found 'void g(char *); void f(int n) { char a[n]; g(a); }' \
        'the frame of f has no known size'
else
    skip "the_core_has_no_recursion" "${CC:-cc} writes no call graph"
fi

# ---- arithmetic: symptom: gcc left to its defaults fused a * b + c, and proved bounds did not hold ----
contract() { "$1" -std=gnu11 -O2 "$2" -S -o - "$scratch/sum.c" 2>/dev/null | grep -c 'v*fmadd'; }
for compiler in "${CC:-cc}" clang aarch64-linux-gnu-gcc; do
    command -v "$compiler" >/dev/null || continue
    case $("$compiler" -dumpmachine) in
    x86_64*) fused=-mfma ;;
    aarch64*) fused=-march=armv8-a ;;
    *) continue ;;
    esac
    echo 'double f(double a, double b, double c) { return a * b + c; }' >"$scratch/plain.c"
    cp "$scratch/plain.c" "$scratch/sum.c"
    same "$compiler could_fuse" "$(contract "$compiler" $fused)" 1
    sed '/lrcs\.h"$/,$d' "$scratch/joined/lrcs.c" | cat - "$scratch/plain.c" >"$scratch/sum.c"
    same "$compiler is_kept_from_it" "$(contract "$compiler" $fused)" 0
done
"${CC:-cc}" -ffast-math -Wfatal-errors -fsyntax-only "$scratch/joined/lrcs.c" 2>/dev/null
same fast_math_is_refused "$?" 1

# ---- a program ----
same they_include_nothing_but_freestanding_like_headers \
    "$(sed -n 's/^#include //p' "$scratch/joined/lrcs.c" "$scratch/joined/lrcs.h" | LC_ALL=C sort -u | tr '\n' ' ')" \
    '"lrcs.h" <float.h> <math.h> <stddef.h> <stdint.h> <string.h> '
sed 's/<lrcs\/lrcs.h>/"lrcs.h"/' examples/embed.c >"$scratch/embed.c"
said=$("${CC:-cc}" -std=c11 "-I$scratch/joined" -o "$scratch/embed" "$scratch/embed.c" "$scratch/lrcs.o" -lm 2>&1)
same a_program_needs_nothing_else "$?: $said" "0: "
same and_says_the_same "$("$scratch/embed")" "$("$(dirname "$tool")/examples/embed")"
finish
