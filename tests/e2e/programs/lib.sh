# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Functions for the tests of other people's programs. To be sourced with the folder of our programs
# and, behind it, the programs that the test needs. Sets emulator, and folder, an empty one in which
# the test runs.
set -euo pipefail

emulator=$(realpath "$1")/hapnet-emulator
for tool in jq "${@:2}"; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool" && exit 77; }
done
folder=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; wait; rm -rf "$folder"' EXIT
cd "$folder"

fail() {
    echo "FAILED: $1" >&2
    tail -n 20 ./*.{log,err,json} 2>/dev/null >&2 || true
    exit 1
}

# await WORDS FILE: waits until FILE contains them.
await() {
    for _ in {1..400}; do
        grep -q -- "$1" "$2" 2>/dev/null && return
        sleep 0.05
    done
    fail "no '$1' in $2"
}

# stand_between UPSTREAM_PORT [OPTION...]: starts an emulator before a server on loopback, with 80
# ms and 5 % loss. Sets port, the one for clients.
stand_between() {
    local upstream=$1
    shift
    "$emulator" --listen 127.0.0.1:0 --upstream "127.0.0.1:$upstream" --delay 40ms --loss 5% \
        --stats stats.json "$@" >emulator.log 2>emulator.err &
    relay=$!
    await ready emulator.log
    port=$(sed -n 's/.*listen=127.0.0.1:\([0-9]*\).*/\1/p' emulator.log)
    [[ $port =~ ^[0-9]+$ ]] || fail "no port in its line ready"
}

# end_between: ends that emulator, and expects that it has counted everything, and lost something.
end_between() {
    kill "$relay"
    wait "$relay" || fail "the emulator ended with $?"
    expect_counts stats.json
}

# expect_counts FILE: the accounting identity in both directions, and datagrams both ways.
expect_counts() {
    jq -e '[.up, .down][] | .received > 0 and
        .received + .duplicated == .delivered + ([.dropped[]] | add) + .in_flight' \
        "$1" >identity.log || fail "the statistics in $1 do not add up"
}

# run_between OPTION... -- A... --- B...: by `between`; passes where the system has no namespaces.
run_between() {
    local code=0
    "$emulator" between --stats stats.json "$@" >out.log 2>between.err || code=$?
    ((code != 3)) || { tail -n 1 between.err && echo "skipped: refused" && exit 77; }
    ((code == 0)) || fail "$* ended with $code"
    expect_counts stats.json
}
