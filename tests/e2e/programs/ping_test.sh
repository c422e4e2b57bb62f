#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# ping and ping6, over 80 ms and 5 %: no round trip is shorter, and what is missing was lost here.
# Among three commands each pair has its round trip, and a ping of the group reaches the two others.
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

# among_three [COMMAND...]: from A to B and C, from B to C, and from A to all, run by COMMAND.
among_three() {
    local each='ping -n -c 5 -i 0.1' code=0
    rm -f ./*.rtt stats.json
    "$@" "$emulator" between --delay 10ms --set a-c.delay=40ms --set b-c.delay=20ms \
        --stats stats.json -- sh -c "$each b >a-b.rtt; $each -6 c6 >a-c.rtt
            ping -n -c 3 ff02::1%eth0 >all.rtt; until [ -s b-c.rtt ]; do sleep 0.1; done" --- \
        sh -c "$each c >b-c.new; mv b-c.new b-c.rtt; sleep infinity" --- sleep infinity \
        >out.log 2>between.err || code=$?
    ((code == 0)) || fail "three commands ended with $code"
    local row file least
    for row in a-b:20 a-c:80 b-c:40; do
        file=${row%:*}.rtt
        least=$(sed -n 's/^rtt .* = \([0-9]*\)\..*/\1/p' "$file")
        ((least >= ${row#*:} && least < ${row#*:} + 15)) || fail "$row: $(cat "$file")"
    done
    for row in 2 3; do
        grep -q "from fe80::ff:fe00:$row%eth0: .* time=" all.rtt ||
            fail "$row misses the group: $(cat all.rtt)"
    done
    expect_counts stats.json
}
among_three
if ((EUID == 0)) && as=(setpriv --reuid 65534 --regid 65534 --clear-groups) &&
    "${as[@]}" "$emulator" between -- true --- true >out.log 2>&1; then
    chmod 1777 "$folder"
    among_three "${as[@]}"
fi
echo passed
