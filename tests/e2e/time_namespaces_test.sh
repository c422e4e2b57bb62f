#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Two peers of one machine meet although one of them is in a time namespace, whose clock is 5000 s
# ahead: both name the same boot, and the echoes tell that their clocks are two.
# Usage: time_namespaces_test.sh FOLDER-WITH-THE-PROGRAMS
set -euo pipefail

programs=$(realpath "$1")
command -v jq >/dev/null || { echo "skipped: there is no jq" && exit 77; }
apart=(unshare --user --map-current-user --time --boottime 5000 --fork --kill-child=TERM)
"${apart[@]}" true 2>/dev/null || { echo "skipped: no time namespaces here" && exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "FAILED: $1" >&2
    tail -n 20 "$folder"/*.err >&2
    exit 1
}
export XDG_STATE_HOME=$folder/state

# peer ID PORT OTHER-PORT
peer() {
    "$programs/hapnet-peer" --id "$1" --listen "127.0.0.1:$2" --remote "127.0.0.1:$3" --task P1 \
        --duration 4s --record "$folder/$1.rec" 2>"$folder/$1.err"
}
export -f peer
export folder programs
timeout 30 bash -c "peer 1 7101 7102" &
first=$!
timeout 30 "${apart[@]}" bash -c "peer 2 7102 7101" || fail "peer 2 ended with $?"
wait "$first" || fail "peer 1 ended with $?"

"$programs/hapnet-lab" analyse "$folder/1.rec" "$folder/2.rec" --json >"$folder/analysis.json" ||
    fail "no analysis"
jq -e '.clock.method == "echo" and (.clock.offset_ms / 1000 - 5000 | fabs) < 1
    and .a_to_b.received > 2000 and .b_to_a.received > 2000 and .settled_discrepancy_mm <= 0.1
    ' "$folder/analysis.json" >/dev/null ||
    fail "the analysis: $(jq -c '[.clock, .a_to_b, .b_to_a]' "$folder/analysis.json")"
