#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# From a fresh clone to the main job: two peers with simulated Omnis share the cube through the
# emulator, over real UDP, under the 160 ms of the paper.
set -euo pipefail

usage="usage: scripts/demo.sh [--peers N] [--scene turning] [--duration SECONDS] [--programs DIR]
                       [--out DIR]
       scripts/demo.sh --web [--virtual] [--programs DIR] [--out DIR]
Installs what is missing, builds, runs task P1 for 30 s and T3 for 20 s with a delay of 160 ms
each way, and prints what was measured beside the paper's Table 1. Writes everything to DIR
(results/demo-<time> when not given). With --peers N, 3 to 8, N hands carry the cube together
instead (T7), for 20 s or --duration SECONDS through an emulator with a link for every two, 40 ms
each way; their analysis is printed. With --scene turning, two hands or N turn a cube (T8) that
way. --web shows sessions on a page instead, with the network under your fingers, until Ctrl-C;
with --virtual in virtual time, without any UDP. --programs DIR takes the programs in DIR and builds
nothing. Exits 0 when it went well, 1 when a program failed or the measurement misses, 2 for an
unknown argument, 3 when something that it needs cannot be installed."

command_line="scripts/demo.sh${*:+ $*}"
refuse() {
    echo "demo: $1" >&2
    exit 2
}
out='' peers=2 scene='' seconds='' programs='' web='' virtual=''
while (($# > 0)); do
    case $1 in
    --out | --programs)
        (($# > 1)) || refuse "$1: which directory?"
        case $1 in
        --out) out=$2 ;;
        *) programs=$(realpath "$2") ;;
        esac
        shift 2
        ;;
    --peers)
        (($# > 1)) || refuse "--peers: how many? 2 to 8"
        peers=$2 && shift 2
        ;;
    --scene)
        (($# > 1)) || refuse "--scene: which? turning"
        scene=$2 && shift 2
        ;;
    --duration)
        (($# > 1)) || refuse "--duration: how many seconds?"
        seconds=${2%s} && shift 2
        ;;
    --web) web=yes && shift ;;
    --virtual) virtual=--virtual && shift ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'"$'\n'"$usage" ;;
    esac
done
[[ $peers =~ ^[2-8]$ ]] || refuse "--peers $peers: write 2 to 8"
[[ -z $scene || $scene == turning ]] || refuse "--scene $scene: write turning, or leave it out"
[[ -z $seconds || $seconds =~ ^[1-9][0-9]*$ ]] || refuse "--duration: a whole number of seconds"
circle=''
if ((peers > 2)) || [[ -n $scene ]]; then circle=yes; fi
[[ -n $circle || -z $seconds ]] || refuse "--duration goes with --peers 3 to 8 or --scene turning"
[[ -z $virtual || -n $web ]] || refuse "--virtual goes with --web"
[[ -z $web || -z $circle$seconds ]] || refuse "--web has its own choice of peers, tasks and seconds"
[[ -z $out ]] || out=$(realpath -m "$out")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=${out:-$PWD/results/demo-$(date -u +%Y%m%dT%H%M%SZ)}
program=demo bin=${programs:-build/release/bin}
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

# run_circle TASK: so many hands at one cube, and how far apart their copies of it were.
run_circle() {
    local folder=$out/${1,,} records=() id
    mkdir -p "$folder"
    printf '\ndemo: task %s with %s hands for %s s, 40 ms each way; what peer 1 says:\n' \
        "$1" "$peers" "$seconds"
    start_links "$folder" "$peers" --delay 40ms --seed 42
    play_circle "$folder" "$seconds" "$peers" --task "$1"
    for ((id = 1; id <= peers; id++)); do
        records+=("$folder/peer-$id.rec")
        "$bin/hapnet-lab" export "$folder/peer-$id.rec" --csv >"$folder/peer-$id.csv"
        "$bin/hapnet-lab" export "$folder/peer-$id.rec" --csv --rows bodies \
            >"$folder/peer-$id-bodies.csv"
    done
    "$bin/hapnet-lab" analyse "${records[@]}" --json >"$folder/analysis.json"
    echo
    "$bin/hapnet-lab" analyse "${records[@]}" | tee "$folder/table.txt"
    "$bin/hapnet-lab" report "${records[@]}" >/dev/null
    "$bin/hapnet-lab" demo-report "$out" --command "$command_line" --start "$start" \
        --wall-time $((SECONDS - started))
    printf '\ndemo: the report with plots, a page to open: %s\n' "$folder/report.html"
    printf 'demo: records, rows (CSV) and statistics are beside it, manifest.json is in %s\n' "$out"
}

# show_page: the live page, until Ctrl-C.
show_page() {
    local opened=$1/address page
    mkdir -p "$1"
    rm -f "$opened"
    # shellcheck disable=SC2086 # $virtual is one word, or none
    "$bin/hapnet-web" --stage $virtual --out "$1" --url-file "$opened" >/dev/null &
    page=$!
    trap 'kill -TERM "$page" 2>/dev/null || true' INT TERM
    for _ in {1..100}; do
        [[ -s $opened ]] && break
        kill -0 "$page" 2>/dev/null || break
        sleep 0.1
    done
    if [[ -s $opened ]]; then
        printf 'demo: open %s\n' "$(<"$opened")"
        if [[ -n ${DISPLAY-}${WAYLAND_DISPLAY-} ]] && command -v xdg-open >/dev/null; then
            xdg-open "$(<"$opened")" >/dev/null 2>&1 || true
        fi
    fi
    local code=0
    wait "$page" || code=$?
    ((code <= 128)) || { code=0 && wait "$page" || code=$?; }
    rm -f "$opened"
    ((code == 0)) && printf '\ndemo: records, captures and statistics lie in %s\n' "$1"
    return "$code"
}

if [[ -n $web ]]; then
    [[ -n $programs ]] || build_programs hapnet-web hapnet-emulator hapnet-peer hapnet-lab
    [[ -x $bin/hapnet-web ]] || { echo "demo: $bin/hapnet-web is not there" >&2 && exit 3; }
    code=0
    show_page "$out" || code=$?
    exit "$code"
fi
if [[ -n $circle ]]; then
    [[ -n $programs ]] || build_programs hapnet-emulator hapnet-peer hapnet-lab
    start=$(date -u +%FT%TZ)
    started=$SECONDS
    seconds=${seconds:-20} task=T7
    [[ -z $scene ]] || task=T8
    run_circle "$task"
    exit
fi
[[ -n $programs ]] || build_programs hapnet-emulator hapnet-peer
mkdir -p "$out"
if [[ -z $programs ]]; then
    echo "demo: hapnet-lab, which the results need, is built beside the sessions"
    build_beside "$out/build.log" hapnet-lab
fi
start=$(date -u +%FT%TZ)
started=$SECONDS
run_task P1 30
run_task T3 20
[[ -n $programs ]] || finish_build
conclude P1
conclude T3
verdict=0
echo
"$bin/hapnet-lab" demo-report "$out" --command "$command_line" --start "$start" \
    --wall-time $((SECONDS - started)) | tee "$out/table.txt" || verdict=$?
printf '\ndemo: the report with plots, a page to open: %s\n' "$out/report.html"
printf 'demo: records, rows (CSV), statistics and manifest.json are beside it\n'
exit "$verdict"
