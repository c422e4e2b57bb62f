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
(that of the
tarball needs none). --jobs is how many shards a machine plays at a time (default 1), each on all
processors. Run it again after something died: it plays what is missing.
Exits 0 when all is merged, 1 when something failed, 2 for a wrong argument."

refuse() {
    echo "ssh: $1"$'\n'"$usage" >&2
    exit 2
}

directory=
shards=
jobs=1
hosts=()
while (($# > 0)); do
    case $1 in
    --shards) shards=${2-} && shift 2 ;;
    --jobs) jobs=${2-} && shift 2 ;;
    --hosts)
        [[ -f ${2-} ]] || refuse "--hosts: a file"
        hosts=(--sshloginfile "$(realpath "$2")") && shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    --) shift && break ;;
    -*) refuse "unknown argument '$1'" ;;
    *) directory=$1 && shift ;;
    esac
done
[[ -f $directory/plan.json ]] || refuse "'$directory' has no plan.json"
[[ $shards =~ ^[1-9][0-9]*$ ]] || refuse "--shards: a number of shards"
lab=${HAPNET_BIN:+$(realpath "$HAPNET_BIN")/}hapnet-lab
lab=$(command -v "$lab") || refuse "there is no $lab"
command -v parallel >/dev/null || refuse "there is no GNU parallel"

cd "$directory"
mkdir -p shards
missing=()
for ((shard = 0; shard < shards; ++shard)); do
    [[ -e shards/$shard-of-$shards.done ]] || missing+=("$shard")
done
if ((${#missing[@]} > 0)); then
    # A program that is replaced while it runs must not be written to.
    rm -f hapnet-lab && cp "$lab" hapnet-lab
    threads=()
    ((jobs == 1)) || threads=(--jobs 1)
    remote=()
    ((${#hosts[@]} == 0)) || remote=(--workdir "hapnet-$(cksum <plan.json | cut -d ' ' -f 1)"
        --cleanup --basefile hapnet-lab
        --basefile plan.json
        --return "shards/{}-of-$shards.jsonl" --return "shards/{}-of-$shards.done")
    parallel --will-cite --jobs "$jobs" --retries 3 "${hosts[@]}" "${remote[@]}" "$@" \
        ./hapnet-lab run plan.json --shard "{}/$shards" "${threads[@]}" ::: "${missing[@]}"
    rm -f hapnet-lab
fi
"$lab" merge .
