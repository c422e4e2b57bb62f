#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# What takes too long for every change: the laws over ten million datagrams, the emulator's memory
# over ten minutes, floods, and what jitter and order do on real sockets.
set -euo pipefail

usage="usage: scripts/soak.sh [--quick] [--minutes N]
Installs what is missing, builds the release preset, and runs
  1. every law of delay and loss over 10 000 000 virtual datagrams,
  2. an emulator with everything switched on at 20 000 datagrams/s for N minutes (default 10):
     its memory stays flat, nothing is lost that is not counted,
  3. floods of three times what the emulator can take beside a stream of 1 kHz,
  4. each row of the table of jitter and order at 1 kHz for 20 s, against 'predict'.
About N + 4 minutes. --quick: 1 000 000 datagrams, 30 s and 5 s a row, about 2 minutes. Run it as
root, or where SCHED_FIFO is allowed, on a machine that does nothing else: 2 to 4 measure time.
What is written in full is in build/soak/. Exits 0 when all passed, 1 when something failed, 2 for
an unknown argument."

refuse() {
    echo "soak: $1"$'\n'"$usage" >&2
    exit 2
}

packets=10000000
seconds=
row_seconds=20
quick=false
while (($# > 0)); do
    case $1 in
    --quick) quick=true && shift ;;
    --minutes)
        [[ ${2:-} =~ ^[1-9][0-9]{0,4}$ ]] || refuse "--minutes: a whole number, 1 or more"
        seconds=$((60 * $2)) && shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
if $quick; then
    packets=1000000
    row_seconds=5
    seconds=${seconds:-30}
fi
seconds=${seconds:-600}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
{
    scripts/setup.sh --test
    cmake --preset release
    cmake --build --preset release --target property_delay property_loss soak_emulator
} >&2

export HAPNET_SOAK_PACKETS=$packets
export HAPNET_SOAK_SECONDS=$seconds
export HAPNET_SOAK_ROW_SECONDS=$row_seconds
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

run delay-laws property_delay
run loss-laws property_loss
run memory soak_emulator '--gtest_filter=Soak.*'
run floods soak_emulator '--gtest_filter=Flood.*'
run jitter-and-order soak_emulator '--gtest_filter=JitterAndOrder.*'

if ((${#failed[@]} > 0)); then
    echo "soak: FAILED: ${failed[*]} (build/soak/)" >&2
    exit 1
fi
echo "soak: all passed ($packets datagrams a law, $seconds s of memory, $row_seconds s a row)"
