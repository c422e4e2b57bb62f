#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The cells of Table 1 in real time: the daemons and the emulator over loopback UDP and, as root,
# in three network namespaces, beside the same sessions in virtual time.
set -euo pipefail

usage="usage: scripts/real-time.sh --out DIR [--quick] [--peers N] [--task T7|T8] [--delay TIME]
                            [--duration SECONDS] [--programs DIR]
Installs what is missing, builds, plays task P1 with a delay of 160 ms each way with the algorithms
base, sep and dead-reckoning in real time, over loopback and, as root, in network namespaces; one
after the other, 30 s each, so that they do not disturb each other. Writes DIR/real_time.csv, what
DIR/manifest.json says of it, and DIR/real-time/WHERE/ALGORITHM/ with the records of each session.
A session whose own timing was off is named and excluded: leave the machine alone meanwhile.
--quick plays base and dead-reckoning for 10 s over loopback alone. --peers N plays task T7 with so
many peers (2 to 8) and the algorithm base instead, for 60 s through one emulator with a link for
every two and 5 ms each way, over loopback alone; the discrepancy is that of the two farthest apart.
--task T8 turns a cube instead, --delay 40ms sets another delay; both go with --peers, which is then
2 unless it is given.
--programs DIR takes the programs in DIR and builds nothing. Exits 0 when done, 1 when a program
failed, 3 when something that it needs cannot be installed."

command_line="scripts/real-time.sh${*:+ $*}"
refuse() {
    echo "real-time: $1"$'\n'"$usage" >&2
    exit 2
}
out='' quick='' seconds='' programs='' peers='' task='' delay=''
while (($# > 0)); do
    case $1 in
    --quick) quick=yes && shift ;;
    --out | --duration | --programs | --peers | --task | --delay)
        (($# > 1)) || refuse "$1: which value?"
        case $1 in
        --task) task=$2 ;;
        --delay) delay=$2 ;;
        --out) out=$(realpath -m "$2") ;;
        --programs) programs=$(realpath "$2") ;;
        --peers) peers=$2 ;;
        *) seconds=${2%s} ;;
        esac
        shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
[[ -n $out ]] || refuse "--out is required"
[[ ${peers:-2} =~ ^[2-8]$ ]] || refuse "--peers: a number from 2 to 8, not '$peers'"
[[ ${task:-T7} =~ ^T[78]$ ]] || refuse "--task: T7 or T8, not '$task'"
[[ ${delay:-5ms} =~ ^[0-9]+ms$ ]] || refuse "--delay: milliseconds, such as 5ms, not '$delay'"
circle=$peers$task$delay # not empty: a session of hands that carry or turn together
peers=${peers:-2} task=${task:-T7} delay=${delay:-5ms}
algorithms=(base sep dead-reckoning)
[[ -z $quick ]] || algorithms=(base dead-reckoning)
if [[ -z $seconds ]]; then
    seconds=$([[ -z $quick ]] && echo 30 || echo 10)
    [[ -z $circle ]] || seconds=$((2 * seconds))
fi
[[ $seconds =~ ^[1-9][0-9]*$ ]] || refuse "--duration: a whole number of seconds, not '$seconds'"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=real-time bin=${programs:-build/release/bin}
# shellcheck source=scripts/lib/session.sh
. scripts/lib/session.sh
# shellcheck source=scripts/lib/namespaces.sh
. scripts/lib/namespaces.sh

# play_all WHERE OPTION...: a session with each algorithm; the options are the emulator's.
play_all() {
    local algorithm folder played=0
    for algorithm in "${algorithms[@]}"; do
        folder=$out/real-time/$1/$algorithm
        mkdir -p "$folder"
        printf '\nreal-time: %d of %d over %s: %s for %s s; what peer 1 says:\n' \
            $((played += 1)) ${#algorithms[@]} "$1" "$algorithm" "$seconds"
        start_emulator "$folder" --delay 160ms --seed 42 "${@:2}"
        play_session "$folder" "$seconds" --task P1 --algorithm "$algorithm" --insecure
        analyse "$folder"
    done
}

# scene_of T7|T8: where it is played, also by two.
scene_of() { if [[ $1 == T8 ]]; then echo turning; else echo carry; fi; }

# play_many: one session of so many peers.
play_many() {
    local folder=$out/real-time/loopback/${task,,}-$peers id records=()
    mkdir -p "$folder"
    printf '\nreal-time: %s with %d peers for %s s, %s each way; what peer 1 says:\n' \
        "$task" "$peers" "$seconds" "$delay"
    start_links "$folder" "$peers" --delay "$delay" --seed 42
    play_circle "$folder" "$seconds" "$peers" --task "$task" --scene "$(scene_of "$task")"
    for ((id = 1; id <= peers; id++)); do records+=("$folder/peer-$id.rec"); done
    "$bin/hapnet-lab" analyse "${records[@]}" --json >"$folder/analysis.json"
}

[[ -n $programs ]] || build_programs hapnet-emulator hapnet-peer hapnet-lab
start=$(date -u +%FT%TZ)
started=$SECONDS
rm -rf "$out/real-time"
if [[ -n $circle ]]; then play_many; else play_all loopback; fi
if [[ -z $quick$circle ]]; then
    if use_namespaces; then
        play_all namespaces --a "$(socket_of 1)" --b "$(socket_of 2)"
    else
        echo "real-time: so there is no session in network namespaces" >&2
    fi
fi
echo
"$bin/hapnet-lab" real-time "$out" --command "$command_line" --start "$start" \
    --wall-time $((SECONDS - started))
