#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Two peers with keys, each in a network of its own, as in two buildings: they meet over a path that
# loses and delays, and a peer with an unreachable address says so. Root plays it as an ordinary
# user, where the system lets it.
# Usage: keyed_session_test.sh FOLDER-WITH-THE-PROGRAMS
set -euo pipefail

programs=$(realpath "$1")
for tool in unshare jq; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool" && exit 77; }
done
if ((EUID == 0)) && unshare --user --map-user=1000 "$programs/hapnet-emulator" between \
    -- true --- true 2>/dev/null; then
    exec unshare --user --map-user=1000 "$0" "$@"
fi
said=$("$programs/hapnet-emulator" between -- true --- true 2>&1) || {
    echo "skipped: no networks of one's own here: $said"
    exit 77
}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "FAILED: $1" >&2
    tail -n 20 "$folder"/*.err "$folder/said" >&2
    exit 1
}
export folder programs
export XDG_STATE_HOME=$folder/state
"$programs/hapnet-peer" keygen --peers 2 --out "$folder/keys" >/dev/null

# peer ID OPTION...: runs a peer in the network of its side, against the other side.
peer() {
    local id=$1 remote=$HAPNET_B
    shift
    ((id == 1)) || remote=$HAPNET_A
    "$programs/hapnet-peer" --key "$folder/keys/peer-$id.key" --remote "$remote:7000" --task P1 \
        --duration 4s "$@" 2>>"$folder/$id.err"
}
export -f peer

# Loopback, the default, cannot reach another host. The peer refuses it, and its advice works.
"$programs/hapnet-emulator" between -- bash -c 'peer 1' --- sleep infinity >"$folder/said" 2>&1 &&
    fail "a peer that listens on loopback went to another host"
cure=$(grep -o 'use --listen [0-9.:]*' "$folder/1.err") || fail "no cure is named"
export listen=${cure#use --listen }

# B ends with A: A waits until B has written what it measured.
# shellcheck disable=SC2016 # expanded in the networks
"$programs/hapnet-emulator" between --delay 20ms --loss 5% -- \
    bash -c 'peer 1 --listen "$listen" --stats "$folder/1.json"
        code=$?
        for _ in {1..200}; do [[ -e $folder/2.json ]] && break; sleep 0.05; done
        exit $code' --- \
    bash -c 'peer 2 --listen "$listen" --stats "$folder/2.json"' >"$folder/said" 2>&1 ||
    fail "the session did not end well"
for id in 1 2; do
    jq -e '.secure.agreed and .secure.handshakes == 1 and .messages.states_received > 2000 and
           ([.secure["forged", "unsealed", "unknown_key", "other_circle", "misnamed"]] | add) == 0
        ' "$folder/$id.json" >/dev/null ||
        fail "peer $id: $(jq -c '[.secure, .messages]' "$folder/$id.json")"
done
