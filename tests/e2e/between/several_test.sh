#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Three commands and more on one network, as this user and, as root, as one who is not: each pair
# has a path with conditions of its own; streams, pings and groups reach their receivers; what the
# run writes names the paths; commands start and end in their order.
# Usage: several_test.sh FOLDER-WITH-THE-PROGRAMS
set -euo pipefail

emulator=$(realpath "$1")/hapnet-emulator
network=$(realpath "${BASH_SOURCE[0]%/*}")/network.py
for tool in jq python3 setpriv; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool" && exit 77; }
done
code=0
"$emulator" between -- true --- true >/dev/null 2>&1 || code=$?
((code != 3)) || { echo "skipped: no networks of one's own here" && exit 77; }

folder=$(mktemp -d)
chmod 1777 "$folder"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() {
    echo "FAILED: $1" >&2
    tail -n 20 "$folder"/{said,out,err} >&2
    exit 1
}
users=(self)
if ((EUID == 0)) && setpriv --reuid 65534 --regid 65534 --clear-groups \
    "$emulator" between -- true --- true >said 2>&1; then
    users+=(nobody)
fi
user=self
# between WORDS...: runs it as the user; sets code. Replaces the earlier output.
between() {
    local as=()
    rm -f run.json fates.csv run.pcapng
    [[ $user == self ]] || as=(setpriv --reuid 65534 --regid 65534 --clear-groups)
    code=0
    "${as[@]}" "$emulator" between "$@" >out 2>err || code=$?
}
identities='([.up, .down] + [.links[] | .up, .down])[] |
    .received + .duplicated == .delivered + ([.dropped[]] | add) + .in_flight'

streams_and_groups() {
    between --delay 2ms --stats run.json -- "$network" streams a 4 --- "$network" streams b 4 --- \
        "$network" streams c 4 --- "$network" streams d 4
    ((code == 0)) || fail "streams between four ended with $code"
    grep -q '^streams a b c d$' out || fail 'a stream is missing'
    jq -e "[$identities] | all" run.json >said || fail 'the statistics do not add up'
    # Each pair has its own stream, both ways, and no other traffic: 300 kB and headers.
    jq -e '(.links | keys) == ["a-b", "a-c", "a-d", "b-c", "b-d", "c-d"] and
        ([.links[] | .up, .down] | all(.bytes_in > 300000 and .bytes_in < 500000)) and
        ([.links[] | .up.received] | add) == .up.received and
        (.frames | keys) == ["a", "b", "c", "d"] and .frames.d.interface == "wire-d" and
        ([.frames[] | .undisturbed] | min) > 0 and ([.frames[] | .oversized] | max) == 0' \
        run.json >said || fail 'the pairs have other traffic'

    between --delay 2ms -- "$network" groups a 3 --- "$network" groups b 3 --- "$network" groups c 3
    ((code == 0)) || fail "groups among three ended with $code"
    for name in group all net group6; do
        grep -q "^$name b c$" out || fail "not all others hear $name"
    done
}

pings() {
    command -v ping >/dev/null || { echo 'not tested: there is no ping' && return; }
    # Each pair of a, b and c has another delay, set in all three ways.
    printf '%s\n' '[matrix]' 'peers = ["a", "b", "c"]' \
        'delay = [["0ms", "9ms", "21ms"], ["9ms", "0ms", "1ms"], ["21ms", "1ms", "0ms"]]' \
        '[link.b-c]' 'up.delay = "30ms"' >matrix.toml
    chmod 644 matrix.toml
    local each='-n -q -c 5 -i 0.05'
    between --profile matrix.toml --set a-c.up.delay=41ms --stats run.json -- \
        sh -c "ping $each b; ping -6 $each c6; cat \$0" b-to-c --- \
        sh -c "ping $each c >b-to-c.new; mv b-to-c.new b-to-c; sleep infinity" --- sleep infinity
    # rtts FILE: the least of each ping in it
    rtts() { sed -n 's/^rtt .* = \([0-9]*\)\..*/\1/p' "$1"; }
    readarray -t least < <(rtts out)
    rm -f b-to-c
    ((code == 0 && ${#least[@]} == 3)) || fail "pings among three ended with $code"
    # 9 + 9, 41 + 21 and 30 + 1: never less, and less than 15 ms more
    local i want=(18 62 31)
    for i in 0 1 2; do
        ((least[i] >= want[i] && least[i] < want[i] + 15)) || fail "round trips of ${least[*]} ms"
    done
    jq -e '.links."a-c".configuration_at_start.up.delay == "41ms" and
        .links."a-c".configuration_at_start.down.delay == "21ms" and
        .links."b-c".up.received >= 5' run.json >said || fail 'wrong conditions'
}

written() {
    local all=(--up.loss 30% --seed 7 --fates fates.csv --stats run.json --pcap run.pcapng)
    local probe="$emulator probe b:7002 --count 60 --rate 400 --wait 100ms"
    between "${all[@]}" -- sh -c "$probe; ${probe/b:/c:}; exit 4" --- \
        "$emulator" probe --answer '[::]:7002' --- "$emulator" probe --answer '[::]:7002'
    ((code == 4)) || fail "the exit code is $code, not that of A"
    grep -q '^link,direction,' fates.csv || fail 'the fates do not name their links'
    grep -c '^a-c,up,' fates.csv >said
    (($(cat said) >= 60)) || fail 'fates are missing'
    ! cmp -s <(sed -n 's/^a-b,up,//p' fates.csv | head -n 40) \
        <(sed -n 's/^a-c,up,//p' fates.csv | head -n 40) || fail 'two links have the same fates'
    jq -e '.links."a-c".up.lens.over_time | length > 0' run.json >said || fail 'no lens over time'
    "$emulator" verify run.json --link a-c >said || fail 'a link does not follow its profile'
    "$emulator" report run.json --link a-c --out page.html 2>said || fail 'no page of a link'
    grep -q 'a-c' page.html || fail 'the page does not name its link'
    rm page.html
    captured
    mv fates.csv first.csv
    between --replay first.csv --fates fates.csv -- sh -c "$probe; ${probe/b:/c:}" --- \
        "$emulator" probe --answer '[::]:7002' --- "$emulator" probe --answer '[::]:7002'
    cmp -s <(sed -n '/^a-c,up,/p' fates.csv | head -n 60) \
        <(sed -n '/^a-c,up,/p' first.csv | head -n 60) || fail 'fates are not replayed'
    rm first.csv
}

captured() {
    command -v tshark >/dev/null || { echo 'not tested: the capture, without tshark' && return; }
    tshark -r run.pcapng -T fields -e frame.interface_name -e ip.src -e ip.dst -e frame.comment \
        -Y 'udp.dstport == 7002' >out 2>said
    grep -q $'^a (to c)\t10.0.0.1\t10.0.0.3\tdropped: random-loss$' out || fail 'no loss'
    grep -q $'^c (to a)\t10.0.0.1\t10.0.0.3\tlate [0-9]* us$' out || fail 'no departure'
    local arrived dropped left
    arrived=$(grep -c $'^a (to c).*\tdelayed' out)
    dropped=$(grep -c $'^a (to c).*\tdropped' out)
    left=$(grep -c $'^c (to a).*\tlate' out)
    ((arrived == left && arrived + dropped >= 60)) ||
        fail "$arrived arrived, $dropped were dropped, $left left"
}

order() {
    # A starts when all listen, or without that option after 1 s. The ends of others are reported.
    local listening="sh -c 'sleep 0.3; exec $network groups b 3'"
    between -- sh -c 'echo a >>started' --- sh -c "echo b >>started; $listening" --- \
        sh -c 'echo c >>started; exit 6'
    ((code == 0)) || fail "it ended with $code"
    [[ $(sort started | tr '\n' ' ') == 'a b c ' && $(tail -n 1 started) == a ]] ||
        fail "they started in this order: $(tr '\n' ' ' <started)"
    rm started
    grep -q 'command C has ended with 6, before command A' err || fail 'C ended in silence'
    between -- true --- sleep infinity --- sh -c 'trap "" TERM; sleep 1000'
    ((code == 0)) || fail "it ended with $code"
    # shellcheck disable=SC2016 # the command expands it
    between -- sh -c 'getent ahostsv4 h; echo $HAPNET_H6' --- sleep 9 --- sleep 9 --- sleep 9 --- \
        sleep 9 --- sleep 9 --- sleep 9 --- sleep 9
    ((code == 0)) || fail "eight ended with $code"
    grep -q '^10.0.0.8 ' out || fail 'h is not a name'
    grep -q '^fd00::8$' out || fail 'h has no address of IPv6'
    # Commands of between, nested in each other.
    local inner="$emulator between -- getent ahostsv4 c --- sleep 9 --- sleep 9"
    between -- sh -c "$inner" --- sh -c "$inner >inner; sleep 9" --- sleep 9
    ((code == 0)) || fail "nested, it ended with $code"
    grep -q '^10.0.0.3 ' out || fail 'nothing nests in A'
    grep -q '^10.0.0.3 ' inner || fail 'nothing nests in B'
    rm inner
}

refusals() {
    # refused WORDS WORD...: expects a usage error with these words.
    refused() {
        between "${@:2}"
        ((code == 2)) || fail "${*:2} ended with $code"
        grep -q -- "$1" err || fail "no '$1' on stderr"
    }
    local three=(-- true --- true --- true)
    refused 'there is no link a-d: use one of a-b, a-c, b-c' --set a-d.delay=1ms "${three[@]}"
    refused 'there is no link b-a: use one of a-b, a-c, b-c' --set b-a.delay=1ms "${three[@]}"
    refused 'two commands have one path' --set a-b.delay=1ms -- true --- true
    refused '9 commands are too many' "${three[@]}" --- true --- true --- true --- true --- true \
        --- true
    refused 'two commands are required' -- true --- true ---
}

for user in "${users[@]}"; do
    for part in streams_and_groups pings written order refusals; do $part; done
done
echo "passed (${users[*]})"
