#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Runs the shards of a plan as an array of Slurm jobs, then merges them.
set -euo pipefail

usage="usage: scripts/slurm.sh DIR --shards N [-- SBATCH_OPTION ...]
DIR is what hapnet-lab plan wrote, on a file system that the nodes share; hapnet-lab is the one in
PATH, or in the folder that HAPNET_BIN names. Submits an array of the shards that have not ended and
a job that merges when they have, and prints the numbers of both. What was submitted lies in
DIR/slurm. Run it again after something died: it submits what is missing. Choose N so that a shard
takes some ten minutes; each takes as many threads as --cpus-per-task (1) gives it. With --wait
among the options of sbatch it returns when all is merged.
Exits 0 when the jobs are submitted, 1 when Slurm refused them, 2 for a wrong argument."

name=slurm
own_option() { return 1; }
# shellcheck source=scripts/lib/shards.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib/shards.sh"
read_plan "$@"
command -v sbatch >/dev/null || refuse "there is no sbatch: Slurm's commands are not here"

mkdir -p "$directory/slurm"
find_missing
after=()
if ((${#missing[@]} > 0)); then
    cat >"$directory/slurm/shard.sbatch" <<EOF
#!/bin/bash
#SBATCH --job-name=hapnet-shard --requeue --open-mode=append
#SBATCH --output=$directory/slurm/shard-%a.log
exec "$lab" run "$directory" --shard "\$SLURM_ARRAY_TASK_ID/$shards" \\
    --jobs "\${SLURM_CPUS_PER_TASK:-1}"
EOF
    list=$(IFS=, && echo "${missing[*]}")
    array=$(sbatch --parsable --array="$list" "${rest[@]}" "$directory/slurm/shard.sbatch")
    echo "slurm: ${#missing[@]} shards of $shards: job ${array%%;*}"
    after=(--dependency="afterok:${array%%;*}" --kill-on-invalid-dep=yes)
fi
cat >"$directory/slurm/merge.sbatch" <<EOF
#!/bin/bash
#SBATCH --job-name=hapnet-merge --output=$directory/slurm/merge.log
exec "$lab" merge "$directory" --jobs "\${SLURM_CPUS_PER_TASK:-1}"
EOF
merging=$(sbatch --parsable "${after[@]}" "${rest[@]}" "$directory/slurm/merge.sbatch")
echo "slurm: merged by job $merging"
