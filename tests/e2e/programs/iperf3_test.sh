#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# iperf3 measures TCP in both directions, over 80 ms and 5 %, and no more than a limit of the rate
# lets through without loss; of three commands each pair has a limit of its own.
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" iperf3

# measured: prints the report of command A.
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

# From A to B, from A to C and from C to B at once.
run_between --rate 20Mbit/s --set a-c.rate=5Mbit/s --set b-c.delay=10ms -- sh -c \
    'iperf3 -c b -p 5201 -t 4 -J >a-b.json & iperf3 -c c -t 4 -J >a-c.json; wait
        until [ -s b-c.json ]; do sleep 0.1; done' --- \
    sh -c 'iperf3 -s -p 5201 --logfile b1.log & iperf3 -s -p 5202 --logfile b2.log; wait' --- \
    sh -c 'iperf3 -s --logfile c.log & iperf3 -c b -p 5202 -t 4 -J >b-c.new
        mv b-c.new b-c.json; wait'
# rate FILE LEAST MOST: in Mbit/s
rate() {
    jq -e --argjson least "$2" --argjson most "$3" '.end.sum_received.bits_per_second / 1e6 |
        . > $least and . < $most' "$1" >said.log || fail "$1 is not between $2 and $3 Mbit/s"
}
rate a-b.json 10 20
rate a-c.json 2.5 5
rate b-c.json 8 20
jq -e '(.links | keys) == ["a-b", "a-c", "b-c"] and .links."b-c".down.bytes_in > 4e6' stats.json \
    >said.log || fail 'the links have other traffic'
echo passed
