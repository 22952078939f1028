#!/bin/sh
# SPDX-License-Identifier: MIT
# Packs a folder of seeds, such as libFuzzer leaves, for test/fuzz/seeds: one seed a line, in
# base64, sorted, each once.
# usage: pack.sh FOLDER >test/fuzz/seeds/NAME
for seed in "$1"/*; do
    base64 <"$seed" | tr -d '\n'
    echo
done | LC_ALL=C sort -u
