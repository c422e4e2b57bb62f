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
nothing. A session during which the machine was too busy to keep its timing is played once more.
Takes about 4 minutes on two cores, 1 minute once everything is built. Exits 0 when the run is valid
and no row is missed, 1 when a program failed, the run is not valid or a row is missed, 2 for an
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

# step N WORDS: announces step N, of $steps.
steps=3
step() {
    printf '\ndemo: step %d of %d, %s\n' "$1" "$steps" "$2"
}

# why_invalid FOLDER: the reasons why the session in it is not valid, in a line; empty when it is.
why_invalid() {
    jq -rs '[.[0].invalid_because[], (.[1] | select(.valid | not) | .invalid_because[] |
        "emulator " + .)] | join("; ")' "$1/analysis.json" "$1/emulator.json"
}

# run_session FOLDER TASK SECONDS: two hands at one cube, 160 ms apart; or $peers, 40 ms apart.
run_session() {
    local folder=$1 delay=160ms
    [[ -z $circle ]] || delay=40ms
    printf 'demo: task %s with %d hands for %s s, %s each way; what A, peer 1, says:\n' \
        "$2" "$peers" "$3" "$delay"
    if [[ -n $circle ]]; then
        start_links "$folder" "$peers" --delay "$delay" --seed 42
    else
        start_emulator "$folder" --delay "$delay" --seed 42
    fi
    play_session "$folder" "$3" --task "$2" || return
    analyse "$folder"
}

# play_quietly TASK SECONDS: plays a session and analyses it; once more when the machine was too
# busy for it.
play_quietly() {
    local folder=$out/${1,,} try why
    mkdir -p "$folder"
    for try in 1 2; do
        why="a program failed"
        ! run_session "$folder" "$@" || why=$(why_invalid "$folder")
        [[ -n $why ]] || return 0
        printf '\ndemo: the machine was too busy for task %s (%s). ' "$1" "$why"
        ((try == 2)) || printf 'It is played once more.\n'
    done
    printf 'Close what else runs and start the demo again.\n'
    [[ $why != "a program failed" ]]
}

# export_rows FOLDER: rows for other tools, beside the records of a session.
export_rows() {
    local folder=$1 id
    for ((id = 1; id <= peers; id++)); do
        "$bin/hapnet-lab" export "$folder/peer-$id.rec" --csv >"$folder/peer-$id.csv"
        [[ -z $circle ]] || "$bin/hapnet-lab" export "$folder/peer-$id.rec" --csv --rows bodies \
            >"$folder/peer-$id-bodies.csv"
    done
}

# conclude: the manifest and, of P1 and T3, the page and the table. Fails when the run is not valid
# or a row is missed.
conclude() {
    "$bin/hapnet-lab" demo-report "$out" --command "$command_line" --start "$start" \
        --wall-time $((SECONDS - started))
}

# show_results PAGE WORDS: prints the last lines.
show_results() {
    printf '\ndemo: records, rows (CSV), statistics and manifest.json are in %s\n' "$out"
    printf 'demo: open file://%s\n' "$1"
    printf 'demo: this page shows %s\n' "$2"
}

# open_page ADDRESS FOLDER: opens a browser, if there is one. Arguments are seen by every user of
# the machine, so the browser is given a file of mode 0600 that leads to the address and its token.
open_page() {
    [[ -n ${DISPLAY-}${WAYLAND_DISPLAY-} ]] && command -v xdg-open >/dev/null || return 0
    (umask 077 && printf '<meta http-equiv="refresh" content="0; url=%s">\n' "$1" >"$2/page.html")
    xdg-open "$2/page.html" >/dev/null 2>&1 || true
}

# show_page FOLDER: shows the live page, until Ctrl-C.
show_page() {
    local private opened page
    mkdir -p "$1"
    private=$(mktemp -d "$1/address.XXXXXX") # of mode 0700
    opened=$private/address
    # shellcheck disable=SC2086 # $virtual is one word, or none
    with_script "$bin/hapnet-web" --stage $virtual --out "$1" --url-file "$opened" >/dev/null &
    page=$!
    trap 'kill -TERM "$page" 2>/dev/null || true' INT TERM
    for _ in {1..100}; do
        [[ -s $opened ]] && break
        kill -0 "$page" 2>/dev/null || break
        sleep 0.1
    done
    if [[ -s $opened ]]; then
        printf 'demo: open %s\n' "$(<"$opened")"
        open_page "$(<"$opened")" "$private"
    fi
    local code=0
    wait "$page" || code=$?
    ((code <= 128)) || { code=0 && wait "$page" || code=$?; }
    rm -rf "$private"
    ((code == 0)) && printf '\ndemo: records, captures and statistics lie in %s\n' "$1"
    return "$code"
}

# prepare PROGRAM...: the first step.
prepare() {
    if [[ -n $programs ]]; then
        step 1 "programs: those in $programs"
        return
    fi
    step 1 "packages and programs: about 3 minutes on two cores, seconds once they are built"
    build_programs "$@"
}

if [[ -n $web ]]; then
    steps=2
    prepare hapnet-web hapnet-emulator hapnet-peer hapnet-lab
    [[ -x $bin/hapnet-web ]] || { echo "demo: $bin/hapnet-web is not there" >&2 && exit 3; }
    step 2 "the live page, until Ctrl-C"
    code=0
    show_page "$out" || code=$?
    exit "$code"
fi
prepare hapnet-emulator hapnet-peer hapnet-lab
mkdir -p "$out"
start=$(date -u +%FT%TZ)
started=$SECONDS
verdict=0
if [[ -n $circle ]]; then
    seconds=${seconds:-20} task=T7
    [[ -z $scene ]] || task=T8
    folder=$out/${task,,}
    step 2 "a session of $seconds s in real time"
    play_quietly "$task" "$seconds"
    step 3 "results"
    export_rows "$folder"
    "$bin/hapnet-lab" analyse "$folder"/peer-[1-8].rec | tee "$folder/table.txt"
    "$bin/hapnet-lab" report "$folder"/peer-[1-8].rec >/dev/null
    conclude || verdict=$?
    show_results "$folder/report.html" \
        "each copy of the cube with the hands at it, and their forces and distances over time."
    exit "$verdict"
fi
step 2 "two sessions in real time: about 55 s, in which nothing else should run"
play_quietly P1 30
play_quietly T3 20
step 3 "results"
for folder in "$out"/{p1,t3}; do export_rows "$folder"; done
conclude | tee "$out/table.txt" || verdict=$?
show_results "$out/report.html" \
    "both copies of the cube as they moved, forces and distances over time, and the paper's table."
exit "$verdict"
