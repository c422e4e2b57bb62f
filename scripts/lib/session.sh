# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Sessions through the emulator, for scripts that play sessions. To be sourced by a script that has
# set program (its name, for messages) and bin (the folder of the programs). Whatever ends the
# script, its sessions end too.

children=()

# Network namespaces of the programs: $namespace-1, -emulator and -2, made by
# scripts/lib/namespaces.sh; empty: on loopback.
namespace=

# with_script COMMAND...: becomes the command, which gets SIGTERM when the script has ended,
# whatever ended it.
with_script() {
    exec setpriv --pdeathsig TERM "$@"
}

# within 1|2|emulator COMMAND...: as with_script, in the namespace of that peer or the emulator.
within() {
    local namespace_words=()
    [[ -z $namespace ]] || namespace_words=(ip netns exec "$namespace-$1")
    with_script "${namespace_words[@]}" "${@:2}"
}

# socket_of 1|2|a|b: the address where that peer, or the emulator on that side, listens.
socket_of() {
    [[ -n $namespace ]] || set -- loopback
    case $1 in
    1) echo 10.77.1.1:7000 ;;
    a) echo 10.77.1.2:7001 ;;
    b) echo 10.77.2.2:7002 ;;
    2) echo 10.77.2.1:7000 ;;
    *) echo 127.0.0.1:0 ;; # any free port
    esac
}

stop_children() {
    ((${#children[@]} > 0)) || return 0
    kill -TERM "${children[@]}" 2>/dev/null || true
    wait "${children[@]}" || true
    children=()
}

# complain WHY [LOG...]: prints the reason and the last lines of the logs.
complain() {
    printf '\n%s: %s\n' "${program:?}" "$1" >&2
    shift
    (($# == 0)) || tail -n 20 "$@" >&2 || true
}

# fail WHY [LOG...]: complains, and ends the script.
fail() {
    complain "$@"
    exit 1
}

trap stop_children EXIT
trap 'echo "$program: interrupted" >&2; exit 130' INT TERM

# build_programs PROGRAM...: installs what is missing and builds these.
build_programs() {
    scripts/setup.sh
    [[ -e build/release/build.ninja ]] || cmake --preset release -DHAPNET_TESTS=OFF
    cmake --build --preset release --parallel "$(nproc)" --target "$@"
}

# await_ready FOLDER: sets ready to the first line of the emulator that was started; empty if it ended.
await_ready() {
    for _ in {1..100}; do
        ready=$(grep -s -m 1 '^ready ' "$1/emulator.out" || true)
        [[ -z $ready ]] || break
        kill -0 "$emulator" 2>/dev/null || break
        sleep 0.05
    done
}

# By the id of each peer of the session: the options that name its remotes.
remotes=()

# start_emulator FOLDER OPTION...: starts one between peers 1 and 2. Sets emulator and remotes.
start_emulator() {
    local folder=$1 ready=
    within emulator "${bin:?}/hapnet-emulator" --listen-a "$(socket_of a)" \
        --listen-b "$(socket_of b)" "${@:2}" --stats "$folder/emulator.json" >"$folder/emulator.out" 2>"$folder/emulator.log" &
    emulator=$!
    children+=("$emulator")
    await_ready "$folder"
    [[ $ready =~ a=([^ ]+)\ b=([^ ]+) ]] ||
        fail "the emulator did not start:" "$folder/emulator.log"
    remotes=([1]="--remote ${BASH_REMATCH[1]}" [2]="--remote ${BASH_REMATCH[2]}")
}

# start_links FOLDER PEERS OPTION...: like start_emulator, with a link for every two of PEERS peers.
start_links() {
    local folder=$1 peers=$2 links=() ready='' i j word
    for ((i = 1; i < peers; i++)); do
        for ((j = i + 1; j <= peers; j++)); do
            links+=(--link "$i-$j=127.0.0.1:0,127.0.0.1:0")
        done
    done
    with_script "${bin:?}/hapnet-emulator" "${links[@]}" "${@:3}" --stats "$folder/emulator.json" \
        >"$folder/emulator.out" 2>"$folder/emulator.log" &
    emulator=$!
    children+=("$emulator")
    await_ready "$folder"
    [[ -n $ready ]] || fail "the emulator did not start:" "$folder/emulator.log"
    remotes=()
    for word in $ready; do
        [[ $word =~ ^([0-9]+)-([0-9]+)=([^,]+),(.+)$ ]] || continue
        i=${BASH_REMATCH[1]} j=${BASH_REMATCH[2]}
        remotes[i]+=" --peer $j=${BASH_REMATCH[3]}"
        remotes[j]+=" --peer $i=${BASH_REMATCH[4]}"
    done
}

# Optional settings of a session: the seed of the hands, and the operator files by the peer's id.
hands_seed=1
declare -A operators=()

# peer ID SECONDS FOLDER OPTION...: becomes a peer until its end.
peer() {
    local words=(--id "$1" --duration "$2s" --seed "$hands_seed" --record "$3/peer-$1.rec"
        --stats "$3/peer-$1.json" --listen "$(socket_of "$1")")
    [[ -z ${operators[$1]:-} ]] || words+=(--operator "${operators[$1]}")
    # shellcheck disable=SC2086 # words
    within "$1" timeout --kill-after 5 $(($2 + 30)) "$bin/hapnet-peer" "${words[@]}" \
        ${remotes[$1]} "${@:4}" >"$3/peer-$1.out"
}

# wait_for_peers FOLDER EMULATOR PEER...: waits until all peers have ended, then ends the emulator.
# Fails when a peer fails, or the emulator ends before.
wait_for_peers() {
    local folder=$1 emulator=$2 awaited=("${@:3}") ended left one
    children=("${@:2}")
    while ((${#awaited[@]} > 0)); do
        if ! wait -n -p ended "$emulator" "${awaited[@]}" || [[ $ended == "$emulator" ]]; then
            stop_children
            complain "a program failed; its records and logs are in $folder" "$folder"/*.log
            return 1
        fi
        left=()
        for one in "${awaited[@]}"; do [[ $one == "$ended" ]] || left+=("$one"); done
        awaited=("${left[@]}")
    done
    children=("$emulator")
    stop_children
}

# play_session FOLDER SECONDS PEER-OPTION...: plays a session through the started emulator, which
# then ends too. Shows the output of peer 1. Fails when a program fails.
play_session() {
    local folder=$1 seconds=$2 id running=()
    for id in "${!remotes[@]}"; do
        if ((id == 1)); then
            peer 1 "$seconds" "$folder" "${@:3}" &
        else
            peer "$id" "$seconds" "$folder" "${@:3}" 2>"$folder/peer-$id.log" &
        fi
        running+=("$!")
    done
    wait_for_peers "$folder" "$emulator" "${running[@]}"
}

# analyse FOLDER: prints metrics of the records in it.
analyse() {
    "$bin/hapnet-lab" analyse "$1"/peer-[1-8].rec --json >"$1/analysis.json"
}
