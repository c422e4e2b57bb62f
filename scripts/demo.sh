#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# From a fresh clone to the main job: two peers with simulated Omnis share the cube through the
# emulator, over real UDP, under the 160 ms of the paper.
set -euo pipefail

usage="usage: scripts/demo.sh [--peers N] [--out DIR]
Installs what is missing, builds, runs task P1 for 30 s and T3 for 20 s with a delay of 160 ms
each way, and prints what was measured beside the paper's Table 1. Writes everything to DIR
(results/demo-<time> when not given). With --peers N, 3 to 8, N hands carry the cube together
instead (T7), for 20 s through an emulator with a link for every two, 40 ms each way; their
analysis is printed. Exits 0 when it went well, 1 when a program failed or the measurement misses,
2 for an unknown argument, 3 when something that it needs cannot be installed."

command_line="scripts/demo.sh${*:+ $*}"
out=
peers=2
while (($# > 0)); do
    case $1 in
    --out)
        (($# > 1)) || { echo "demo: --out: which directory?" >&2 && exit 2; }
        out=$2 && shift 2
        ;;
    --peers)
        (($# > 1)) || { echo "demo: --peers: how many? 2 to 8" >&2 && exit 2; }
        peers=$2 && shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) echo "demo: unknown argument '$1'"$'\n'"$usage" >&2 && exit 2 ;;
    esac
done
[[ $peers =~ ^[2-8]$ ]] || { echo "demo: --peers $peers: write 2 to 8" >&2 && exit 2; }
[[ -z $out ]] || out=$(realpath -m "$out")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=${out:-$PWD/results/demo-$(date -u +%Y%m%dT%H%M%SZ)}
program=demo bin=build/release/bin
# shellcheck source=scripts/lib/session.sh
. scripts/lib/session.sh

run_task() {
    local folder=$out/${1,,}
    mkdir -p "$folder"
    printf '\ndemo: task %s for %s s, 160 ms each way; what peer 1 says:\n' "$1" "$2"
    start_emulator "$folder" --delay 160ms --seed 42
    play_session "$folder" "$2" --task "$1"
}

# Metrics and rows for other tools, beside the records of a task.
conclude() {
    local folder=$out/${1,,} id
    analyse "$folder"
    for id in 1 2; do
        "$bin/hapnet-lab" export "$folder/peer-$id.rec" --csv >"$folder/peer-$id.csv"
    done
}

# So many hands at one cube, and how far apart their copies of it were.
run_circle() {
    local folder=$out/t7 records=() id
    mkdir -p "$folder"
    printf '\ndemo: task T7 with %s hands for 20 s, 40 ms each way; what peer 1 says:\n' "$peers"
    start_links "$folder" "$peers" --delay 40ms --seed 42
    play_circle "$folder" 20 "$peers" --task T7
    for ((id = 1; id <= peers; id++)); do
        records+=("$folder/peer-$id.rec")
        "$bin/hapnet-lab" export "$folder/peer-$id.rec" --csv >"$folder/peer-$id.csv"
    done
    "$bin/hapnet-lab" analyse "${records[@]}" --json >"$folder/analysis.json"
    echo
    "$bin/hapnet-lab" analyse "${records[@]}" | tee "$folder/table.txt"
    "$bin/hapnet-lab" report "${records[@]}" >/dev/null
    printf '\ndemo: the report with plots, a page to open: %s\n' "$folder/report.html"
    printf 'demo: records, rows (CSV) and statistics are beside it\n'
}

if ((peers > 2)); then
    build_programs hapnet-emulator hapnet-peer hapnet-lab
    run_circle
    exit
fi
build_programs hapnet-emulator hapnet-peer
mkdir -p "$out"
echo "demo: hapnet-lab, which the results need, is built beside the sessions"
build_beside "$out/build.log" hapnet-lab
start=$(date -u +%FT%TZ)
started=$SECONDS
run_task P1 30
run_task T3 20
finish_build
conclude P1
conclude T3
verdict=0
echo
"$bin/hapnet-lab" demo-report "$out" --command "$command_line" --start "$start" \
    --wall-time $((SECONDS - started)) | tee "$out/table.txt" || verdict=$?
printf '\ndemo: the report with plots, a page to open: %s\n' "$out/report.html"
printf 'demo: records, rows (CSV), statistics and manifest.json are beside it\n'
exit "$verdict"
