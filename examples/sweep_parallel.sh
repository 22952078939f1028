#!/bin/sh
# SPDX-License-Identifier: MIT
# A sweep in shards by GNU parallel, as many at a time as there are processors; run again, it goes on
# with what is there. On several machines that share the folder: --sshlogin HOST,HOST --wd .
# usage: sweep_parallel.sh OUT SHARDS SCENE WHAT...   (OUT: .csv or .npy)
#   sh sweep_parallel.sh map.npy 64 satellite.toml --az 0:360:1 --el -90:90:1
out=$1
shards=$2
shift 2
# exit 3: a row misses the tolerance, and says so
seq "$shards" | parallel -q sh -c '"$@" || [ $? -eq 3 ]' sh \
    lrcs sweep "$@" --jobs 1 --resume --shard "{}/$shards" -o "$out.{}.csv" &&
    lrcs merge "$out".*.csv -o "$out"
