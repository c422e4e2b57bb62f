#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Runs the shards of a plan on machines that ssh reaches, by GNU parallel, then merges them.
set -euo pipefail

usage="usage: scripts/ssh.sh DIR --shards N [--hosts FILE] [--jobs N] [-- PARALLEL_OPTION ...]
DIR is what hapnet-lab plan wrote; hapnet-lab is the one in PATH, or in the folder that HAPNET_BIN
names. FILE has a line for each machine, as GNU parallel's --sshloginfile: [USER@]HOST, or a whole
command of ssh. Without --hosts this machine plays. Program and plan are copied there, and what was
played comes back: the machines share no disk, and need rsync and the libraries of the program
(that of the tarball needs none). --jobs is how many shards a machine plays at a time (default 1),
each on all processors. Run it again after something died: it plays what is missing.
Exits 0 when all is merged, 1 when something failed, 2 for a wrong argument."

name=ssh
jobs=1
hosts=()
own_option() {
    taken=2
    case $1 in
    --jobs) jobs=${2-} ;;
    --hosts)
        [[ -f ${2-} ]] || refuse "--hosts: a file"
        hosts=(--sshloginfile "$(realpath "$2")")
        ;;
    *) return 1 ;;
    esac
}
# shellcheck source=scripts/lib/shards.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib/shards.sh"
read_plan "$@"
command -v parallel >/dev/null || refuse "there is no GNU parallel"

cd "$directory"
mkdir -p shards
find_missing
if ((${#missing[@]} > 0)); then
    # A running program must be replaced, not written to.
    rm -f hapnet-lab && cp "$lab" hapnet-lab
    threads=()
    ((jobs == 1)) || threads=(--jobs 1)
    remote=()
    ((${#hosts[@]} == 0)) || remote=(--workdir "hapnet-$(cksum <plan.json | cut -d ' ' -f 1)"
        --cleanup --basefile hapnet-lab
        --basefile plan.json
        --return "shards/{}-of-$shards.jsonl" --return "shards/{}-of-$shards.done")
    parallel --will-cite --jobs "$jobs" --retries 3 "${hosts[@]}" "${remote[@]}" "${rest[@]}" \
        ./hapnet-lab run plan.json --shard "{}/$shards" "${threads[@]}" ::: "${missing[@]}"
    rm -f hapnet-lab
fi
"$lab" merge .
