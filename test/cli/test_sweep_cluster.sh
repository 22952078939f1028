#!/bin/sh
# SPDX-License-Identifier: MIT
# The scripts in examples/ that spread a sweep, by GNU parallel and by Slurm on a node of its own:
# what they make is the single run's file.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
examples=$root/examples
what='demo --az 0:90:10 --el -20:20:10 --tolerance 1e-2'
mkdir bin
ln -s "$tool" bin/lrcs
PATH=$scratch/bin:$PATH
export PATH
# shellcheck disable=SC2086
for kind in csv npy; do
    lrcs sweep $what -o whole.$kind 2>/dev/null
done

# equal NAME FILE FILE
equal() { if cmp -s "$2" "$3"; then ok "$1"; else not_ok "$1" "$(ls; cat ./*.txt slurm*)"; fi; }

# ---- GNU parallel ----
if parallel --version 2>/dev/null </dev/null | grep -q '^GNU parallel'; then
    # shellcheck disable=SC2086
    PARALLEL_HOME=$scratch sh "$examples/sweep_parallel.sh" map.npy 5 $what >parallel.txt 2>&1
    equal parallel_makes_the_single_runs_map map.npy whole.npy
    # shellcheck disable=SC2086
    PARALLEL_HOME=$scratch sh "$examples/sweep_parallel.sh" map.npy 5 $what >parallel.txt 2>&1
    equal and_again_from_what_is_there map.npy whole.npy
else
    skip "parallel_makes_the_single_runs_map" "no GNU parallel"
    skip "and_again_from_what_is_there" "no GNU parallel"
fi

# ---- Slurm: its daemons started here, for this test alone ----
PATH=$PATH:/usr/sbin
for needed in slurmctld slurmd sbatch squeue; do
    command -v $needed >/dev/null || missing=$needed
done
if [ "${missing:-}" ]; then
    skip "slurm_makes_the_single_runs_file" "no $missing"
    finish
    exit
fi
mkdir state spool
host=$(hostname -s)
port=$((20000 + $$ % 20000))
cat >slurm.conf <<END
ClusterName=lrcs
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
MpiDefault=none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
ReturnToService=2
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=ALL Default=YES
END
SLURM_CONF=$scratch/slurm.conf
export SLURM_CONF
slurmctld -D >slurmctld.txt 2>&1 &
control=$!
slurmd -D >slurmd.txt 2>&1 &
node=$!
trap 'kill $node $control 2>/dev/null; wait $node $control 2>/dev/null; rm -rf "$scratch"' EXIT
for _ in $(seq 60); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && break
    sleep 0.5
done
if [ "$(sinfo -h -o %t 2>/dev/null)" != idle ]; then
    skip "slurm_makes_the_single_runs_file" "Slurm does not start here"
    finish
    exit
fi
# shellcheck disable=SC2086
sh "$examples/sweep_slurm.sh" map.csv 3 $what >sbatch.txt 2>&1
for _ in $(seq 120); do
    [ -z "$(squeue -h 2>/dev/null)" ] && break
    sleep 0.5
done
equal slurm_makes_the_single_runs_file map.csv whole.csv
finish
