#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# From a fresh clone to the main job: two peers with simulated Omnis share the cube through the
# emulator, over real UDP, under the 160 ms of the paper.
set -euo pipefail

usage="usage: scripts/demo.sh [--out DIR]
Installs what is missing, builds, runs task P1 for 30 s and T3 for 20 s with a delay of 160 ms
each way, and prints what was measured beside the paper's Table 1. Writes everything to DIR
(results/demo-<time> when not given). Exits 0 when it went well, 1 when a program failed or the
measurement misses, 3 when something that it needs cannot be installed."

command_line="scripts/demo.sh${*:+ $*}"
out=
while (($# > 0)); do
    case $1 in
    --out) out=${2:?"--out: which directory?"} && shift 2 ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) echo "demo: unknown argument '$1'"$'\n'"$usage" >&2 && exit 2 ;;
    esac
done
[[ -z $out ]] || out=$(realpath -m "$out")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=${out:-$PWD/results/demo-$(date -u +%Y%m%dT%H%M%SZ)}
bin=build/release/bin
children=()

stop_children() {
    ((${#children[@]} == 0)) || kill -TERM "${children[@]}" 2>/dev/null || true
    wait
    children=()
}

fail() {
    printf '\ndemo: %s\n' "$1" >&2
    shift
    tail -n 20 "$@" >&2 || true
    exit 1
}

trap stop_children EXIT
trap 'echo "demo: interrupted" >&2; exit 130' INT TERM

build() {
    scripts/setup.sh
    cmake --preset release -DHAPNET_TESTS=OFF
    cmake --build --preset release --target hapnet-emulator hapnet-peer hapnet-lab
}

# Starts the emulator on free ports and sets emulator, address_a and address_b.
start_emulator() {
    local folder=$1 ready=
    "$bin/hapnet-emulator" --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 --delay 160ms --seed 42 \
        --stats "$folder/emulator.json" >"$folder/emulator.out" 2>"$folder/emulator.log" &
    emulator=$!
    children+=("$emulator")
    for _ in {1..100}; do
        ready=$(grep -m 1 '^ready ' "$folder/emulator.out" || true)
        [[ -z $ready ]] || break
        kill -0 "$emulator" 2>/dev/null || break
        sleep 0.05
    done
    [[ $ready =~ a=([^ ]+)\ b=([^ ]+) ]] ||
        fail "the emulator did not start:" "$folder/emulator.log"
    address_a=${BASH_REMATCH[1]}
    address_b=${BASH_REMATCH[2]}
}

# peer ID ADDRESS TASK SECONDS FOLDER: runs one peer to its end.
peer() {
    exec timeout --kill-after 5 $(($4 + 30)) "$bin/hapnet-peer" --id "$1" --listen 127.0.0.1:0 \
        --remote "$2" --task "$3" --duration "$4s" --seed 1 \
        --record "$5/peer-$1.rec" --stats "$5/peer-$1.json" >"$5/peer-$1.out"
}

# wait_for_one TASK EMULATOR PEER...: sets ended to the first of them that ends. That has to be a
# peer, and all has to be well with it.
wait_for_one() {
    if ! wait -n -p ended "${@:2}" || [[ $ended == "$2" ]]; then
        fail "a program of task $1 failed:" "$out/${1,,}"/*.log
    fi
}

run_task() {
    local task=$1 seconds=$2 folder=$out/${1,,}
    mkdir -p "$folder"
    printf '\ndemo: task %s for %s s, 160 ms each way; what peer 1 says:\n' "$task" "$seconds"
    start_emulator "$folder"
    peer 2 "$address_b" "$task" "$seconds" "$folder" 2>"$folder/peer-2.log" &
    local peer_2=$!
    peer 1 "$address_a" "$task" "$seconds" "$folder" &
    local peer_1=$!
    children=("$emulator" "$peer_1" "$peer_2")
    local left=$peer_2
    wait_for_one "$task" "$emulator" "$peer_1" "$peer_2"
    [[ $ended != "$peer_2" ]] || left=$peer_1
    wait_for_one "$task" "$emulator" "$left"
    children=("$emulator")
    stop_children
}

# Metrics and rows for other tools, beside the records of a task.
analyse() {
    local folder=$out/${1,,} id
    "$bin/hapnet-lab" analyse "$folder/peer-1.rec" "$folder/peer-2.rec" --json \
        >"$folder/analysis.json"
    for id in 1 2; do
        "$bin/hapnet-lab" export "$folder/peer-$id.rec" --csv >"$folder/peer-$id.csv"
    done
}

build
start=$(date -u +%FT%TZ)
started=$SECONDS
run_task P1 30
run_task T3 20
analyse P1
analyse T3
verdict=0
echo
"$bin/hapnet-lab" demo-report "$out" --command "$command_line" --start "$start" \
    --wall-time $((SECONDS - started)) | tee "$out/table.txt" || verdict=$?
printf '\ndemo: the report with plots, a page to open: %s\n' "$out/report.html"
printf 'demo: records, rows (CSV), statistics and manifest.json are beside it\n'
exit "$verdict"
