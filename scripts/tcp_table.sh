#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The throughput of TCP through the emulator, against delay and loss, beside theory.
set -euo pipefail

usage="usage: scripts/tcp_table.sh [--quick] [--seconds N] [--rate MBIT] [--markdown FILE]
Installs what is missing, builds the emulator, and has iperf3 send from one end of
'hapnet-emulator between' to the other, by CUBIC and, where the kernel has it, by BBR: with delays
of 5, 20 and 50 ms each way, losses of 0, 0.1 and 1 % of the packets with data, and one limit of the
rate (default 100 Mbit/s) before a queue of one bandwidth-delay product; and once without any
condition. Each for N seconds (default 20) after 8 s that do not count: about 10 minutes in all;
--quick: 3 s after 1 s, too short for CUBIC to forget its start. Prints a table, and writes it to
FILE as Markdown, too.

Theory, of the payload: the least of the rate without headers and, by the segments that may be in
flight at a loss p, Mathis' sqrt(3/2/p) or what RFC 9438 gives for CUBIC, whichever is more; BBR
takes no loss of this size for congestion, and is bounded by the rate alone. 'window' is the most
that was in flight by the sender's own count, in segments. The bar is met within 25 % of theory, and
without conditions from 1 Gbit/s on.
Exits 0 when it has measured, 1 when a run failed, 2 for an unknown argument, 3 when something that
it needs is missing."

refuse() {
    echo "tcp_table: $1"$'\n'"$usage" >&2
    exit 2
}

seconds=20
omitted=8
rate=100
markdown=
while (($# > 0)); do
    case $1 in
    --quick) seconds=3 && omitted=1 && shift ;;
    --seconds | --rate)
        [[ ${2:-} =~ ^[1-9][0-9]{0,3}$ ]] || refuse "$1: a whole number, 1 to 9999"
        if [[ $1 == --rate ]]; then rate=$2; else seconds=$2; fi
        shift 2
        ;;
    --markdown)
        [[ -n ${2:-} ]] || refuse "--markdown: the name of a file"
        markdown=$2 && shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
[[ -z $markdown || $markdown == /* ]] || markdown=$PWD/$markdown

cd "$(dirname "${BASH_SOURCE[0]}")/.."
{
    scripts/setup.sh --programs
    [[ -e build/release/build.ninja ]] || cmake --preset release -DHAPNET_TESTS=OFF
    cmake --build --preset release --target hapnet-emulator
} >&2
emulator=$PWD/build/release/bin/hapnet-emulator
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'echo "tcp_table: interrupted" >&2; exit 130' INT TERM

laws=(cubic)
available=$(cat /proc/sys/net/ipv4/tcp_available_congestion_control)
# Users other than root may only select allowed algorithms.
((EUID == 0)) || available=$(cat /proc/sys/net/ipv4/tcp_allowed_congestion_control)
if [[ " $available " == *' bbr '* ]]; then
    laws+=(bbr)
else
    echo "tcp_table: no BBR: this kernel, or this user, has only $available (as root: modprobe" \
        "tcp_bbr; sysctl -w net.ipv4.tcp_allowed_congestion_control='$available bbr')" >&2
fi

# measure LAW OPTION...: prints Mbit/s of payload, retransmissions, the largest window in segments,
# mean round trip in ms, and the 99th percentile of the emulator's lateness in us.
measure() {
    local law=$1 code=0
    shift
    (cd "$folder" && exec "$emulator" between --stats run.json "$@" -- \
        iperf3 --client b --congestion "$law" --time "$seconds" --omit "$omitted" --json --- \
        iperf3 --server --one-off --logfile server.log) >"$folder/report.json" 2>"$folder/said" ||
        code=$?
    if ((code != 0)); then
        { tail -n 5 "$folder/said" && jq -r '.error // empty' "$folder/report.json"; } >&2
        echo "tcp_table: $law $* ended with $code" >&2
        ((code != 3)) || exit 3
        exit 1
    fi
    jq -r --slurpfile run "$folder/run.json" '.end as $e | .start.tcp_mss_default as $mss |
        [$e.sum_received.bits_per_second / 1e6, $e.sum_sent.retransmits,
         ($e.streams[0].sender.max_snd_cwnd / $mss), $e.streams[0].sender.mean_rtt / 1e3,
         $run[0].up.lateness_us.p99] | map(tostring) | join(" ")' "$folder/report.json"
}

# theory LAW DELAY_MS LOSS_PERCENT: in Mbit/s. A segment has 1448 bytes of 1500, with timestamps.
theory() {
    awk -v law="$1" -v rtt="$(awk -v d="$2" 'BEGIN { print 2 * d / 1000 }')" -v loss="$3" \
        -v rate="$rate" 'BEGIN {
        best = rate * 1448 / 1500
        p = loss / 100
        if (law == "cubic" && p > 0) {
            mathis = sqrt(1.5 / p)
            cubic = 1.054 * (rtt / p) ^ 0.75 # C = 0.4, beta = 0.7
            window = cubic > mathis ? cubic : mathis
            by_loss = window * 1448 * 8 / rtt / 1e6
            if (by_loss < best) best = by_loss
        }
        printf "%.1f", best
    }'
}

line='%-6s %9s %7s %10s %9s %7s %7s %8s %8s %8s %10s\n'
head=(law delay loss measured theory ratio bar retrans. window RTT lateness)
# shellcheck disable=SC2059 # the formats are above
printf "$line" "${head[@]}"
# shellcheck disable=SC2059
printf "$line" '' 'each way' '' Mbit/s Mbit/s '' '' '' segments ms 'p99, us'
rows=()
# row LAW DELAY LOSS THEORY MEASURED...
row() {
    local law=$1 delay=$2 loss=$3 expected=$4 ratio=- bar
    [[ $expected == - ]] || ratio=$(awk -v a="$5" -v b="$expected" 'BEGIN { printf "%.2f", a / b }')
    bar=$(awk -v rate="$5" -v ratio="$ratio" 'BEGIN {
        print (ratio == "-" ? rate >= 1000 : ratio >= 0.75 && ratio <= 1.25) ? "met" : "missed" }')
    local cells=("$law" "$delay" "$loss" "$(printf '%.1f' "$5")" "$expected" "$ratio" "$bar"
        "$6" "$(printf '%.0f' "$7")" "$(printf '%.1f' "$8")" "$(printf '%.0f' "$9")")
    # shellcheck disable=SC2059
    printf "$line" "${cells[@]}"
    rows+=("$(printf '| %s ' "${cells[@]}")|")
}

for law in "${laws[@]}"; do
    read -ra measured < <(measure "$law" || echo failed)
    [[ ${measured[0]} != failed ]] || exit 1
    row "$law" none 0 - "${measured[@]}"
    for delay in 5 20 50; do
        for loss in 0 0.1 1; do
            queue=$((rate * 2 * delay * 1000 / 8))
            read -ra measured < <(measure "$law" --delay "${delay}ms" --up.loss "$loss%" --up.rate \
                "{ limit = \"${rate}Mbit/s\", queue = \"${queue}B\" }" || echo failed)
            [[ ${measured[0]} != failed ]] || exit 1
            row "$law" "$delay ms" "$loss %" "$(theory "$law" "$delay" "$loss")" "${measured[@]}"
        done
    done
done

if [[ -n $markdown ]]; then
    {
        echo "Measured $(date +%F) on $(nproc) cores, Linux $(uname -r), load $(cut -d' ' -f1 \
            /proc/loadavg), rate ${rate} Mbit/s:"
        echo
        echo '| law | delay each way | loss | measured, Mbit/s | theory, Mbit/s | ratio | bar |' \
            'retransmissions | largest window, segments | mean RTT, ms | lateness p99, µs |'
        echo '|---|---|---|---|---|---|---|---|---|---|---|'
        printf '%s\n' "${rows[@]}"
    } >"$markdown"
fi
