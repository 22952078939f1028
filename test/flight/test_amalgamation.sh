#!/bin/sh
# SPDX-License-Identifier: MIT
# The core as two files: they compile alone without a word, and a program links with nothing else.
. "$(dirname "$0")/../cli/check.sh"

cd "$root" || exit 1
for layer in base mesh optics scene view visibility integrate; do
    set -- "$@" src/$layer/*.c
done
shift # the tool
sh src/amalgamate.sh "$scratch/joined" "$@"
same the_core_joins_into_two_files "$?: $(ls "$scratch/joined")" "0: lrcs.c
lrcs.h"
strict='-std=c11 -pedantic -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion -Werror'
# shellcheck disable=SC2086 # flags are words
said=$("${CC:-cc}" $strict -O0 -c -o "$scratch/lrcs.o" "$scratch/joined/lrcs.c" 2>&1)
same they_compile_alone_without_a_warning "$?: $said" "0: "
if command -v clang >/dev/null; then
    # shellcheck disable=SC2086
    said=$(clang $strict -fsyntax-only "$scratch/joined/lrcs.c" 2>&1)
    same clang_has_no_warning_either "$?: $said" "0: "
fi
same they_include_nothing_but_freestanding_like_headers \
    "$(sed -n 's/^#include //p' "$scratch/joined/lrcs.c" "$scratch/joined/lrcs.h" | LC_ALL=C sort -u | tr '\n' ' ')" \
    '"lrcs.h" <float.h> <math.h> <stddef.h> <stdint.h> <string.h> '
sed 's/<lrcs\/lrcs.h>/"lrcs.h"/' examples/embed.c >"$scratch/embed.c"
said=$("${CC:-cc}" -std=c11 "-I$scratch/joined" -o "$scratch/embed" "$scratch/embed.c" "$scratch/lrcs.o" -lm 2>&1)
same a_program_needs_nothing_else "$?: $said" "0: "
same and_says_the_same "$("$scratch/embed")" "$("$(dirname "$tool")/examples/embed")"
finish
