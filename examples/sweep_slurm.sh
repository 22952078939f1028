#!/bin/sh
# SPDX-License-Identifier: MIT
#SBATCH --job-name=lrcs
#SBATCH --signal=TERM@60
# A sweep in an array of Slurm jobs, and a last job that joins what they made. Before its time is up
# a job stops in order; submitted again, this goes on with what is there.
# usage: sweep_slurm.sh OUT SHARDS SCENE WHAT...   (OUT: .csv, .jsonl or .npy)
#   sh sweep_slurm.sh map.npy 16 satellite.toml --az 0:360:1 --el -90:90:1
# More for each job through sbatch's own variables: SBATCH_TIMELIMIT, SBATCH_PARTITION, ..
out=$1
shards=$2
shift 2
case $out in *.jsonl) kind=jsonl ;; *) kind=csv ;; esac
if [ "${SLURM_ARRAY_TASK_ID:-}" ]; then # exit 3: a row misses the tolerance, and says so
    lrcs sweep "$@" --shard "$SLURM_ARRAY_TASK_ID/$shards" --jobs "${SLURM_CPUS_PER_TASK:-1}" \
        --resume -o "$out.$SLURM_ARRAY_TASK_ID.$kind" || [ $? -eq 3 ]
elif [ "${SLURM_JOB_ID:-}" ]; then
    lrcs merge "$out".*."$kind" -o "$out"
else
    job=$(sbatch --parsable --array="1-$shards" "$0" "$out" "$shards" "$@") || exit 1
    sbatch --dependency="afterok:$job" "$0" "$out" "$shards"
fi
