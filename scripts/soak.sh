#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# What takes too long for every change: the laws over ten million datagrams, the emulator's memory
# over ten minutes, floods, what jitter and order do on real sockets, hostile lines to its control,
# damaged files, a million random scenes, sessions under attack, daemons that are killed in turn,
# and how soon a stop ends a force.
set -euo pipefail

usage="usage: scripts/soak.sh SUBJECT [--quick] [--minutes N]
                       [--first SEED] [--peers N] [--task T7|T8] [--out DIR] [--programs DIR]
Installs what is missing, builds the release preset, and runs one SUBJECT, or all of them (all):
emulator:
  1. every law of delay and loss, and regimes, over 10 000 000 virtual datagrams,
  2. an emulator with everything switched on at 20 000 datagrams/s for N minutes (default 10):
     its memory stays flat, nothing is lost that is not counted,
  3. floods of three times what the emulator can take beside a stream of 1 kHz,
     and of frames between two commands, both ways at once: each packet is in one counter,
  4. each row of the table of jitter and order at 1 kHz for 20 s, against 'predict', and two
     regimes for 60 s against virtual time,
  5. 28 links and then 64 clients on two threads, for N minutes each: nothing is allocated after
     the start, nothing is lost that is not counted;
control:
  6. 100 000 lines to the control socket of an emulator with 64 clients, typical and longest ones,
     changed at random from SEED on: no turn of the thread that relays takes more than 100 us of its
     processor time. One after the other: about 20 minutes. It fails today: a change of 64 clients
     with conditions of their own takes 700 us (docs/adr/0034-control-desk.md);
files:
  7. 2000 files of each of 16 kinds (profiles, fates, captures, scenes, plans, shards, records,
     keys, ...), changed at random from SEED on: the program that reads them ends by itself, with an
     exit code that it documents: about 5 minutes. What breaks this is kept in build/soak/files;
scene:
  8. 1 000 000 random scenes under the laws of energy, momentum and force, from SEED on
     (default 0), on two processes: about ten minutes; and how often guards acted in them. From
     1000000000 on some bodies are round, from 1000000000000 on scenes have every element, in
     which guards act more often (docs/results/limitations.md),
  9. 5000 everyday scenes of each kind (small parts in a tray, bodies in a room with hands, a box
     that rattles in a cube, plates on capsules, cradles, unequal masses) at ticks of 0.5, 1, 2 and
     4 ms, 2000 ticks each: none gains more than 1e-4 of its energy, by formulas of the judge's own
     (at 4 ms one in 5000; of unequal masses one in 1000 gains 1 %), and nothing leaves its room,
 10. the ticks that cost most among 20 000 of the random scenes with at most 8 bodies;
session:
 11. 1000 sessions from SEED on, a third of them without keys, with keys of each side's own, and
     with a shared key as well, and more until 100 000 000 datagrams have reached a side, over
     drawn networks and under an attacker who owns the path: forces, energy and counters in
     each millisecond, with keys what is accepted, and whether the copies agree afterwards; a seed
     that fails is printed with the command that repeats it;
     with --peers N (2 to 8; 2-5: all of these in turn) instead 1000 sessions of N peers, keyed
     alike, over links that lose up to 30 %, in which one peer after the other is killed
     and started again, and two halves may have begun apart; and then 1000 of N peers under that
     attacker, who owns all links;
daemons:
 12. as many daemons as --peers says (default 3), with simulated devices and keys, through one
     emulator with a link for every two (30 % loss, 40 ms +- 10 ms), in rounds of 60 s for N
     minutes: 15 s and 45 s after the start one of them, in turn, is killed (SIGKILL) and started
     again 3 s later; after 57 s the hands let go. A row for each round is printed, by the records
     and statistics of all: 300 ms after the last message of a killed one its force is gone, the
     others' hands are at zero if it touched, after a second they play on; forces are finite and
     limited; in the end the copies are within 0.1 mm and 0.1 degrees. --task T8 turns a cube, for
     three peers at most. --out DIR takes the results instead of build/soak/daemons; --programs
     DIR takes the programs in DIR and builds nothing;
stop:
 13. 100 signals to a daemon in the middle of a push, whose stderr, stdout and record are not read:
     zero force two turns of the loop later at most, within 5 ms at p99, and gone within a second:
     about 6 minutes,
 14. 200 times SIGKILL to a peer at a random moment of a session: by the other peer's record its
     force is zero 300 ms after the last message, about 10 minutes;
energy:
 15. 10 000 random hands, devices and networks, a third with a liar, and 1000 that send less: all
     hands together never draw more energy than remote-proxy's bound, about 20 minutes;
study:
 16. 4000 simulated observers for each of four designs of hapnet-study, from number 1 on: their
     threshold is inside its stated 95 % interval for 93.5 to 96.5 % of them, about 5 minutes.
All of them take about 4 N + 95 minutes. --quick: 200 observers, 1 000 000 datagrams, 30 s and 5 s a
row, 20 000 scenes, 200 sessions, a round of 11 s, 10 signals of each kind, 2000 lines, 50 files of
a kind, about 9 minutes for all. Run emulator, daemons and stop as root, or where SCHED_FIFO is
allowed, on a machine that does nothing else: 2 to 6 and 12 to 14 measure time. A round whose
programs did not keep their time says so under 'valid'.
What is written in full is in build/soak/. Exits 0 when all passed, 1 when something failed, 2
without a subject or for an unknown argument."

refuse() {
    echo "soak: $1"$'\n'"$usage" >&2
    exit 2
}

packets=10000000
seconds=
row_seconds=20
quick=false
scenes=1000000
everyday=5000
sessions=1000
session_packets=100000000
stops=100
kills=200
lines=100000
files=2000
observers=4000
energies=10000
sendings=1000
first=0
peers=
task=T7
out=
programs=
subject=
while (($# > 0)); do
    case $1 in
    all | emulator | control | files | scene | session | daemons | stop | energy | study)
        [[ -z $subject ]] || refuse "one subject, not '$subject' and '$1': 'all' runs each of them"
        subject=$1 && shift
        ;;
    --quick) quick=true && shift ;;
    --first)
        [[ ${2:-} =~ ^[0-9]{1,15}$ ]] || refuse "--first: a seed, a whole number"
        first=$2 && shift 2
        ;;
    --peers)
        [[ ${2:-} =~ ^[2-8](-[2-8])?$ ]] || refuse "--peers: a number from 2 to 8, or two: 2-5"
        peers=$2 && shift 2
        ;;
    --minutes)
        [[ ${2:-} =~ ^[1-9][0-9]{0,4}$ ]] || refuse "--minutes: a whole number, 1 or more"
        seconds=$((60 * $2)) && shift 2
        ;;
    --task)
        [[ ${2:-} =~ ^T[78]$ ]] || refuse "--task: T7 or T8"
        task=$2 && shift 2
        ;;
    --out | --programs)
        [[ -n ${2:-} ]] || refuse "$1: a folder"
        if [[ $1 == --out ]]; then out=$(realpath -m "$2"); else programs=$(realpath -m "$2"); fi
        shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
[[ -n $subject ]] || refuse "name a subject, or 'all'"
if $quick; then
    packets=1000000
    scenes=20000
    everyday=200
    sessions=200
    session_packets=0
    stops=10
    kills=10
    lines=2000
    files=50
    observers=200
    energies=200
    sendings=50
    row_seconds=5
    seconds=${seconds:-30}
fi
seconds=${seconds:-600}
if [[ -n $programs || -n $out || $task != T7 ]]; then
    [[ $subject == daemons ]] || refuse "--task, --out and --programs belong to daemons"
fi
[[ $subject == session || $peers != *-* ]] || refuse "--peers $peers: a range is for session"

cd "$(dirname "${BASH_SOURCE[0]}")/.."
targets=()
if [[ $subject == all || $subject == emulator ]]; then
    targets+=(property_emulator soak_emulator)
fi
if [[ $subject == all || $subject == control ]]; then targets+=(soak_control); fi
if [[ $subject == all || $subject == files ]]; then
    targets+=(hapnet-emulator hapnet-lab hapnet-peer)
fi
if [[ $subject == all || $subject == scene ]]; then targets+=(soak_scene); fi
if [[ $subject == all || $subject == session ]]; then targets+=(soak_session); fi
if [[ $subject == all || $subject == energy ]]; then targets+=(property_peer_core); fi
if [[ $subject == all || $subject == stop ]]; then
    targets+=(e2e hapnet-peer hapnet-lab hapnet-ctl)
fi
if [[ $subject == all || $subject == daemons ]]; then
    targets+=(hapnet-emulator hapnet-peer hapnet-lab soak_daemons)
fi
[[ -n $programs ]] || {
    scripts/setup.sh --test
    cmake --preset release
    cmake --build --preset release --target "${targets[@]}"
} >&2

export HAPNET_SOAK_PACKETS=$packets
export HAPNET_SOAK_SECONDS=$seconds
export HAPNET_SOAK_ROW_SECONDS=$row_seconds
export HAPNET_SOAK_STOPS=$stops
export HAPNET_SOAK_KILLS=$kills
mkdir -p build/soak
failed=()

# run NAME PROGRAM [ARGUMENT ...]: shows what it measures and what failed.
run() {
    local name=$1 started=$SECONDS verdict=passed
    shift
    echo "== $name"
    if ! "build/release/bin/$1" "${@:2}" 2>&1 | tee "build/soak/$name.log" |
        grep --line-buffered -E '^  |Failure|^\[  (FAILED|PASSED)'; then
        verdict=FAILED
        failed+=("$name")
    fi
    echo "== $name: $verdict in $((SECONDS - started)) s"
}

# run_files: the programs read damaged files.
run_files() {
    local started=$SECONDS verdict=passed
    echo "== files"
    python3 tests/soak/files_soak.py . build/release/bin build/soak/files "$files" "$first" ||
        verdict=FAILED
    [[ $verdict == passed ]] || failed+=(files)
    echo "== files: $verdict in $((SECONDS - started)) s"
}

# run_energy: random hands, devices and networks.
run_energy() {
    HAPNET_ENERGY_SESSIONS=$energies run energy property_peer_core \
        '--gtest_filter=All/RemoteProxyEnergy.*:Seed/RemoteProxyEnergy.*'
    HAPNET_ENERGY_SESSIONS=$sendings run sending-less property_peer_core \
        '--gtest_filter=Seed/SendingLess.*'
}

# run_study: the intervals of hapnet-study.
run_study() {
    local started=$SECONDS verdict=passed
    echo "== study"
    python3 tests/soak/study_soak.py "$observers" | tee build/soak/study.log || verdict=FAILED
    [[ $verdict == passed ]] || failed+=(study)
    echo "== study: $verdict in $((SECONDS - started)) s"
}

# run_scenes: two halves of the seeds side by side.
run_scenes() {
    local half=$((scenes / 2)) started=$SECONDS verdict=passed
    echo "== scenes $first to $((first + 2 * half - 1))"
    build/release/bin/soak_scene "$first" "$half" >build/soak/scenes-1.log &
    local other=$!
    build/release/bin/soak_scene "$((first + half))" "$half" | tee build/soak/scenes-2.log ||
        verdict=FAILED
    wait "$other" || verdict=FAILED
    cat build/soak/scenes-1.log
    # The last report of each half: ticks and guards.
    tail -qn 2 build/soak/scenes-1.log build/soak/scenes-2.log | awk '
        /scenes,/ { ticks += $3 }
        $1 == "guards:" { guards += $2 }
        END { printf "  guards in all: %d in %.2g of %d ticks\n", guards, guards / ticks, ticks }'
    [[ $verdict == passed ]] || failed+=(scenes)
    echo "== scenes: $verdict in $((SECONDS - started)) s"
}

# run_everyday: two ticks side by side.
run_everyday() {
    local started=$SECONDS verdict=passed tick others=()
    echo "== everyday scenes from seed $first on"
    for tick in 500 1000 2000 4000; do
        build/release/bin/soak_scene everyday "$first" "$everyday" "$tick" \
            >"build/soak/everyday-$tick.log" &
        others+=($!)
        if ((${#others[@]} == 2)); then
            wait "${others[0]}" || verdict=FAILED
            wait "${others[1]}" || verdict=FAILED
            others=()
        fi
    done
    cat build/soak/everyday-{500,1000,2000,4000}.log
    [[ $verdict == passed ]] || failed+=(everyday)
    echo "== everyday scenes: $verdict in $((SECONDS - started)) s"
}

# run_sessions: a third of them without keys, with own ones, and with a shared one as well.
run_sessions() {
    local packets_each=$((session_packets / 3))
    if [[ -z $peers ]]; then
        play_sessions sessions "under attack" "$packets_each"
        return
    fi
    play_sessions troubled "of $peers peers" 0 --peers "$peers" --troubled
    play_sessions attacked "of $peers peers under attack" 0 --peers "$peers"
}

# play_sessions NAME KIND DATAGRAMS [OPTION ...]
play_sessions() {
    local name=$1 kind=$2 packets_each=$3 third=$((sessions / 3)) started=$SECONDS verdict=passed
    local seal other others=()
    shift 3
    echo "== sessions $kind from seed $first on, $third each without keys, with own and shared ones"
    for seal in own keys; do
        build/release/bin/soak_session "$seal" "$first" "$third" "$packets_each" "$@" \
            >"build/soak/$name-$seal.log" &
        others+=($!)
    done
    build/release/bin/soak_session none "$first" "$third" "$packets_each" "$@" |
        tee "build/soak/$name-none.log" || verdict=FAILED
    for other in "${others[@]}"; do wait "$other" || verdict=FAILED; done
    cat "build/soak/$name-own.log" "build/soak/$name-keys.log"
    [[ $verdict == passed ]] || failed+=("$name")
    echo "== sessions $kind: $verdict in $((SECONDS - started)) s"
}

# run_worst_ticks: of as many scenes as --quick plays.
run_worst_ticks() {
    echo "== the ticks that cost most"
    build/release/bin/soak_scene --worst "$first" 20000 | tee build/soak/worst-ticks.log
}

# run_daemons: rounds of 60 s with two kills each; --quick: a short one with one.
run_daemons() {
    local started=$SECONDS verdict=passed rounds=$(((seconds + 59) / 60)) times=(3 15 45)
    local program=soak bin=${programs:-build/release/bin}
    out=${out:-$PWD/build/soak/daemons} peers=${peers:-3} round_seconds=60
    if $quick; then rounds=1 round_seconds=11 times=(2.5 3); fi
    # shellcheck source=scripts/lib/session.sh
    . scripts/lib/session.sh
    # shellcheck source=scripts/lib/daemons.sh
    . scripts/lib/daemons.sh
    echo "== daemons: $peers peers, task $task, $rounds rounds of $round_seconds s ($out)"
    soak_daemons "$rounds" "${times[@]}" || verdict=FAILED
    [[ $verdict == passed ]] || failed+=(daemons)
    echo "== daemons: $verdict in $((SECONDS - started)) s"
}

if [[ $subject == all || $subject == emulator ]]; then
    run laws property_emulator '--gtest_filter=Laws.*:FourState.*:Gilbert.*:VerifyRegimes.Passes*'
    run memory soak_emulator '--gtest_filter=Soak.*'
    run floods soak_emulator '--gtest_filter=Flood.*'
    run frames soak_emulator '--gtest_filter=FrameFlood.*'
    run jitter-and-order soak_emulator '--gtest_filter=JitterAndOrder.*'
    run regimes soak_emulator '--gtest_filter=Regimes.*'
    run many-paths soak_emulator '--gtest_filter=ManyPaths.*'
fi
if [[ $subject == all || $subject == control ]]; then
    run control soak_control "$lines" "$first"
fi
if [[ $subject == all || $subject == files ]]; then
    run_files
fi
if [[ $subject == all || $subject == scene ]]; then
    run_scenes
    run_everyday
    run_worst_ticks
fi
if [[ $subject == all || $subject == session ]]; then
    run_sessions
fi
if [[ $subject == all || $subject == daemons ]]; then
    run_daemons
fi
if [[ $subject == all || $subject == stop ]]; then
    run stops e2e '--gtest_filter=PeerExit.*NothingThatItWritesIsTaken'
    run kills e2e '--gtest_filter=PeerKill.*'
fi

if [[ $subject == all || $subject == energy ]]; then
    run_energy
fi
if [[ $subject == all || $subject == study ]]; then
    run_study
fi

if ((${#failed[@]} > 0)); then
    echo "soak: FAILED: ${failed[*]} (build/soak/)" >&2
    exit 1
fi
echo "soak: all passed"
