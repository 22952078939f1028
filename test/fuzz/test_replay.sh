#!/bin/sh
# SPDX-License-Identifier: MIT
# Every fuzz target over its seeds and some mutations of them, without libFuzzer.
# Slow targets get fewer.
. "$(dirname "$0")/../cli/check.sh"
for source in "$root"/test/fuzz/fuzz_*.c; do
    name=$(basename "$source" .c)
    name=${name#fuzz_}
    case $name in
    pose) mutations=4000 ;;
    curved | fit) mutations=200 ;;
    scene) mutations=500 ;;
    *) mutations=20000 ;;
    esac
    if "$(dirname "$tool")/test/fuzz/fuzz_$name" "$mutations" "$root/test/fuzz/seeds/$name" \
        2>"$scratch/broken"; then
        ok "$name: its seeds and $mutations mutations break nothing"
    else
        not_ok "$name: its seeds and $mutations mutations break nothing" "$(cat "$scratch/broken")"
    fi
done

# What pack.sh packs is unpacked to the same bytes.
mkdir "$scratch/one" "$scratch/two"
"$(dirname "$tool")/test/fuzz/fuzz_stl" unpack "$scratch/one" "$root/test/fuzz/seeds/stl"
sh "$root/test/fuzz/pack.sh" "$scratch/one" >"$scratch/packed"
same seeds_survive_unpacking_and_packing "$(cksum <"$scratch/packed")" "$(cksum <"$root/test/fuzz/seeds/stl")"
finish
