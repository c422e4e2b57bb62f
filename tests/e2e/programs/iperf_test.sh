#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# iperf 2 sends UDP through a relay: its server misses the datagrams that the emulator lost.
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" iperf

iperf -s -u -B 127.0.0.1 -p 5001 -y C >server.csv 2>server.err &
stand_between 5001
iperf -c 127.0.0.1 -u -p "$port" -b 2M -t 3 -y C >client.csv 2>client.err || fail "iperf: $?"
for _ in {1..200}; do
    [[ -s server.csv ]] && break
    sleep 0.05
done
end_between
# Its columns: ..., jitter, lost, datagrams, percent, out of order.
awk -F, 'END { exit !($12 > 400 && $11 > 0.01 * $12 && $11 < 0.12 * $12) }' server.csv ||
    fail "the server did not miss about 5 %"
lost=$(awk -F, 'END { print $11 }' server.csv)
jq -e --argjson lost "$lost" '.up.dropped.random_loss >= $lost' stats.json >said.log ||
    fail "the server missed more than the emulator lost"
echo passed
