#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# ping and ping6, over 80 ms and 5 %: no round trip is shorter, and what is missing was lost here.
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" ping

for to in '-4 b' '-6 b6'; do
    read -ra words <<<"$to"
    run_between --delay 40ms --loss 5% --seed 3 -- \
        ping "${words[@]}" -n -c 60 -i 0.05 -W 2 --- sleep infinity
    read -r sent received < <(awk '/ packets transmitted, / { print $1, $4 }' out.log)
    ((sent == 60 && received >= 40 && received < 60)) || fail "$received of $sent came back"
    awk -F '[=/]' '/^rtt/ { exit !($5 >= 80) }' out.log || fail "a round trip of less than 80 ms"
    jq -e --argjson missing $((sent - received)) \
        '.up.dropped.random_loss + .down.dropped.random_loss >= $missing' stats.json >said.log ||
        fail "more is missing than was lost"
done
echo passed
