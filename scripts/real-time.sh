#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Sessions in real time, by the daemons and the emulator over UDP, beside the same in virtual time:
# those of an experiment, one after the other; or the cells of Table 1 over loopback and, as root,
# in three network namespaces.
set -euo pipefail

usage="usage: scripts/real-time.sh EXPERIMENT --out DIR [--set KEY=VALUE] [--seeds N] [--quick]
                            [--attempts N] [--keep-records] [--programs DIR]
       scripts/real-time.sh --out DIR [--quick] [--peers N] [--task T7|T8] [--delay TIME]
                            [--duration SECONDS] [--programs DIR]
Plays every session of an experiment (a file, or a built-in one: docs/use/real-time.md) in real time
over loopback, one after the other, and compares each with the same session in virtual time. Writes
DIR/real_time_sessions.csv, a row for each attempt, DIR/real_time_conditions.csv, and what
DIR/manifest.json says of it. A session whose own timing was off is marked and played again, up to 3
attempts in all (--attempts). After Ctrl-C the same command goes on where it was. Records are
removed once they are compared, unless --keep-records is given. Without EXPERIMENT:
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
out='' quick='' seconds='' programs='' peers='' task='' delay='' experiment=''
attempts=3 planned=() keep=()
while (($# > 0)); do
    case $1 in
    --quick) quick=yes && shift ;;
    --keep-records) keep=(--keep-records) && shift ;;
    --out | --duration | --programs | --peers | --task | --delay | --set | --seeds | --attempts)
        (($# > 1)) || refuse "$1: which value?"
        case $1 in
        --task) task=$2 ;;
        --delay) delay=$2 ;;
        --set | --seeds) planned+=("$1" "$2") ;;
        --attempts) attempts=$2 ;;
        --out) out=$(realpath -m "$2") ;;
        --programs) programs=$(realpath "$2") ;;
        --peers) peers=$2 ;;
        *) seconds=${2%s} ;;
        esac
        shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    -*) refuse "unknown argument '$1'" ;;
    *)
        [[ -z $experiment ]] || refuse "one experiment at a time, not '$experiment' and '$1'"
        experiment=$1 && shift
        [[ ! -f $experiment ]] || experiment=$(realpath "$experiment")
        ;;
    esac
done
[[ -n $out ]] || refuse "--out is required"
[[ -z $experiment || -z $peers$task$delay$seconds ]] ||
    refuse "an experiment says its peers, tasks, delays and duration; --set changes them"
[[ -n $experiment || ${#planned[@]} == 0 ]] || refuse "--set and --seeds go with an experiment"
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
        printf '\nreal-time: %d of %d over %s: %s for %s s; what A, peer 1, says:\n' \
            $((played += 1)) ${#algorithms[@]} "$1" "$algorithm" "$seconds"
        start_emulator "$folder" --delay 160ms --seed 42 "${@:2}"
        play_session "$folder" "$seconds" --task P1 --algorithm "$algorithm" --insecure
        analyse "$folder"
    done
}

# scene_of T7|T8: where it is played, also by two.
scene_of() { if [[ $1 == T8 ]]; then echo turning; else echo carry; fi; }

# play_many: plays one session with $circle peers.
play_many() {
    local folder=$out/real-time/loopback/${task,,}-$peers
    mkdir -p "$folder"
    printf '\nreal-time: %s with %d peers for %s s, %s each way; what A, peer 1, says:\n' \
        "$task" "$peers" "$seconds" "$delay"
    start_links "$folder" "$peers" --delay "$delay" --seed 42
    play_session "$folder" "$seconds" --task "$task" --scene "$(scene_of "$task")"
    analyse "$folder"
}

# play_cell FOLDER PEERS TASK SECONDS SEED: plays the session whose files are in the folder.
play_cell() {
    local folder=$1 peers=$2 id
    local network=(--profile "$folder/profile.toml" --seed "$5")
    local play=(--task "$3" --algorithm "$folder/algorithm.toml" --scene "$folder/scene.toml")
    local more
    read -ra more <"$folder/peer.words"
    play+=("${more[@]}")
    hands_seed=$5
    for ((id = 1; id <= peers; id++)); do
        operators[$id]=$folder/$( ((id % 2)) && echo left || echo right).toml
    done
    if ((peers == 2)); then
        start_emulator "$folder" "${network[@]}"
        play+=(--insecure)
    else
        start_links "$folder" "$peers" "${network[@]}"
    fi
    play_session "$folder" "$4" "${play[@]}"
    analyse "$folder"
}

# play_experiment: plays session by session, as hapnet-lab asks for them.
play_experiment() {
    local line folder peers task seconds seed words quickly=()
    [[ -z $quick ]] || quickly=(--quick)
    "$bin/hapnet-lab" plan "$experiment" "${planned[@]}" "${quickly[@]}" --out "$out"
    while true; do
        line=$("$bin/hapnet-lab" real-time "$out" --next --attempts "$attempts")
        [[ -n $line ]] || break
        IFS=$'\t' read -r folder peers task seconds seed words <<<"$line"
        printf '\nreal-time: %s\n' "$words"
        play_cell "$folder" "$peers" "$task" "$seconds" "$seed"
        "$bin/hapnet-lab" real-time "$out" --played "$folder" "${keep[@]}"
    done
}

# conclude: makes the tables from all sessions played.
conclude() {
    echo
    "$bin/hapnet-lab" real-time "$out" --command "$command_line" --start "$start" \
        --wall-time $((SECONDS - started))
}

[[ -n $programs ]] || build_programs hapnet-emulator hapnet-peer hapnet-lab
start=$(date -u +%FT%TZ)
started=$SECONDS
if [[ -n $experiment ]]; then
    # The tables are made also after an interruption.
    trap 'stop_children; [[ -z $(compgen -G "$out/cells/*/*/result.json") ]] || conclude' EXIT
    play_experiment
    exit
fi
rm -rf "$out/real-time"
if [[ -n $circle ]]; then play_many; else play_all loopback; fi
if [[ -z $quick$circle ]]; then
    if use_namespaces; then
        play_all namespaces --a "$(socket_of 1)" --b "$(socket_of 2)"
    else
        echo "real-time: so there is no session in network namespaces" >&2
    fi
fi
conclude
