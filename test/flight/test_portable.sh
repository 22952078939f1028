#!/bin/sh
# SPDX-License-Identifier: MIT
# A big-endian machine gives the same bits as this one: a slice of make portable. Where no such
# compiler or no emulator is installed it skips.
. "$(dirname "$0")/common.sh"

needs a_big_endian_machine_says_the_same s390x-linux-gnu-gcc qemu-s390x
flags='-std=c11 -pedantic -ffp-contract=off -Itest/portable -Itest -Iinclude -Isrc'
# shellcheck disable=SC2086 # flags are words
"${CC:-cc}" $flags -O1 -o "$scratch/here" test/portable/digest.c $library -lm &&
    "$scratch/here" 8 >"$scratch/reference" &&
    join_core "$scratch" &&
    s390x-linux-gnu-gcc $flags -static -O0 -o "$scratch/there" test/portable/digest.c src/analysis/*.c "$scratch/lrcs.c" -lm
same it_builds_for_a_big_endian_machine "$?" 0
said=$(qemu-s390x "$scratch/there" 8 "$scratch/reference" 2>&1)
same a_big_endian_machine_says_the_same "$? $(echo "$said" | grep DIFFERS)" "0 "
# The comparison reports a wrong hash, and a sigma that is wrong by its own size.
sed '1s/[0-9a-f]*$/0123456789abcdef/' "$scratch/reference" >"$scratch/other"
same a_hash_that_differs_is_told "$("$scratch/here" 8 "$scratch/other" 2>&1 | grep -c '^DIFFERS: hash')" 1
sed 's/^\(sigma contacts_3 \)40/\141/' "$scratch/reference" >"$scratch/other"
same a_sigma_that_differs_is_told "$("$scratch/here" 8 "$scratch/other" 2>&1 | grep -c '^DIFFERS: sigma')" 1
finish
