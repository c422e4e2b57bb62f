# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Sessions of daemons of which one after the other is killed and started again, for scripts/soak.sh.
# To be sourced after scripts/lib/session.sh, by a script that has set out (a folder) and task.
# shellcheck disable=SC2154 # program, remotes

# Folder of the current round.
round_folder=
round_runs=()     # by id: number of starts
round_processes=() # by id
kills_so_far=0    # kills in all rounds; chooses the next peer
# Peers return to the same address. Another soak on this machine has other addresses.
loopback=127.$((1 + RANDOM % 250)).$((1 + RANDOM % 250))

# start_daemon ID: starts a new run of a peer, with its own record.
start_daemon() {
    local id=$1 run=$((${round_runs[$1]:-0} + 1))
    round_runs[id]=$run
    # shellcheck disable=SC2086 # words
    with_script "${bin:?}/hapnet-peer" --key "${out:?}/keys/peer-$id.key" --listen "$loopback.$id:7000" \
        ${remotes[id]} --task "${task:?}" --duration "${round_seconds:?}s" --seed 1 \
        --record "$round_folder/peer-$id.$run.rec" --stats "$round_folder/peer-$id.json" \
        >"$round_folder/peer-$id.$run.out" 2>"$round_folder/peer-$id.$run.log" &
    round_processes[id]=$!
    children=("$emulator" "${round_processes[@]}")
}

# await_words ID WORDS: waits until that peer has printed them, 30 s at most.
await_words() {
    local log=$round_folder/peer-$1.${round_runs[$1]}.log
    for _ in {1..600}; do
        ! grep -qs -- "$2" "$log" || return 0
        kill -0 "${round_processes[$1]}" 2>/dev/null || break
        sleep 0.05
    done
    fail "peer $1 did not say '$2':" "$log"
}

# kill_one AWAY: kills the next peer in turn at once, and restarts it after AWAY.
kill_one() {
    local id=$((kills_so_far % peers + 1))
    kills_so_far=$((kills_so_far + 1))
    kill -KILL "${round_processes[id]}"
    { wait "${round_processes[id]}" || true; } 2>/dev/null
    sleep "$1"
    start_daemon "$id"
}

# play_round AWAY WHEN...: plays one session, and kills a peer at each time WHEN after the start.
play_round() {
    local away=$1 when id code started
    round_runs=() round_processes=()
    for ((id = 1; id <= ${peers:?}; id++)); do start_daemon "$id"; done
    for ((id = 1; id <= peers; id++)); do await_words "$id" 'session started'; done
    started=${EPOCHREALTIME/[.,]/}
    for when in "${@:2}"; do
        sleep "$(((started + when * 1000000 - ${EPOCHREALTIME/[.,]/}) / 1000))e-3"
        kill_one "$away"
    done
    for ((id = 1; id <= peers; id++)); do
        code=0
        wait "${round_processes[id]}" || code=$?
        echo "$code" >"$round_folder/peer-$id.exit"
    done
    # shellcheck disable=SC2034 # stop_children() of session.sh reads it
    children=("$emulator")
}

# judge_round KILLS: adds a row to the table. Fails when something was broken.
judge_round() {
    local id records=()
    for ((id = 1; id <= peers; id++)); do
        records+=("$round_folder/peer-$id.${round_runs[id]}.rec")
    done
    "$bin/hapnet-lab" analyse "${records[@]}" --json >"$round_folder/analysis.json" &&
        "$bin/soak_daemons" round "$round_folder" "$peers" "$1"
}

# soak_daemons ROUNDS AWAY WHEN...: plays the rounds through one emulator. Fails if one broke.
soak_daemons() {
    local rounds=$1 round verdict=0
    trap 'echo "$program: interrupted; the table so far and the records are in $out" >&2
          exit 130' INT TERM
    rm -rf "$out"
    mkdir -p "$out"
    "$bin/hapnet-peer" keygen --peers "$peers" --out "$out/keys" >"$out/keygen.out"
    start_links "$out" "$peers" --loss 30% --delay 40ms --jitter 10ms --seed 42
    { printf '%5s' round && "$bin/soak_daemons" header; } | tee "$out/table.txt"
    for ((round = 1; round <= rounds; round++)); do
        round_folder=$out/round-$round
        mkdir -p "$round_folder"
        play_round "${@:2}"
        if { printf '%5d' "$round" && judge_round $(($# - 2)); } >"$out/row.txt"; then
            # A passed round keeps only its statistics: five records grow by 5 MB a second.
            ((round == rounds)) || rm -f "$round_folder"/*.rec
        else
            verdict=1
        fi
        tee -a "$out/table.txt" <"$out/row.txt"
    done
    stop_children
    "$bin/soak_daemons" emulator "$out/emulator.json" >"$out/row.txt" || verdict=1
    tee -a "$out/table.txt" <"$out/row.txt"
    trap 'echo "$program: interrupted" >&2; exit 130' INT TERM
    return $verdict
}
