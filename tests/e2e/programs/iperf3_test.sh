#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# iperf3 measures TCP in both directions, over 80 ms and 5 %, and no more than a limit of the rate
# lets through without loss.
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" iperf3

# measured: the report that command A has printed.
measured() {
    sed -n '/^{$/,/^}$/p' out.log >report.json
    jq -e "$1" report.json >said.log || fail "not so: $1"
}
for way in '' --reverse; do
    run_between --delay 40ms --loss 5% -- iperf3 -c b -t 3 -J $way --- iperf3 -s -1 --logfile b.log
    measured '.end.sum_received.bytes > 10000'
    jq -e '.up.dropped.random_loss + .down.dropped.random_loss > 0' stats.json >said.log ||
        fail "nothing was lost"
    run_between --delay 5ms --rate 10Mbit/s -- iperf3 -c b -t 3 -J $way --- \
        iperf3 -s -1 --logfile b.log
    measured '.end.sum_received.bits_per_second < 1e7 and
        .end.sum_received.bits_per_second > 3e6'
    jq -e '.up.dropped.random_loss + .down.dropped.random_loss == 0' stats.json >said.log ||
        fail "something was lost without a loss"
done
echo passed
