#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The emulator as a bridge between two interfaces, with a host in a network of its own behind each:
# frames of every kind pass byte for byte, both families and a VLAN with their delays, it tells the
# sender of what is too big, a loop or a lost interface ends it, and it says what it lacks. Relays
# say that they have lost their address.
# Usage: bridge_test.sh FOLDER-WITH-THE-PROGRAMS
set -euo pipefail

emulator=$(realpath "$1")/hapnet-emulator
frames=$(realpath "${BASH_SOURCE[0]%/*}")/frames.py
for tool in ip unshare nsenter jq; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool" && exit 77; }
done
if [[ -z ${HAPNET_BRIDGE_TEST-} ]]; then
    own=(--net)
    ((EUID == 0)) || own=(--user --map-root-user --net)
    unshare "${own[@]}" true || { echo "skipped: no network of one's own here" && exit 77; }
    HAPNET_BRIDGE_TEST=yes exec unshare "${own[@]}" "$0" "$@"
fi
ip address add fd09::9/64 dev lo nodad || { echo "skipped: no IPv6 here" && exit 77; }
ip address delete fd09::9/64 dev lo

folder=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; wait; rm -rf "$folder"' EXIT
fail() {
    echo "FAILED: $1" >&2
    tail -n 20 "$folder"/* >&2
    exit 1
}
# await WORDS FILE
await() {
    for _ in {1..200}; do
        grep -q "$1" "$2" 2>/dev/null && return
        sleep 0.05
    done
    fail "no '$1' in $2"
}

# The hosts keep their offloads, so checksums are left to devices that do not compute them.
hosts=()
for side in 1 2; do
    ip link add "wire$side" type veth peer name "host$side"
    ip link set "wire$side" up
    unshare --net sleep 1000 &
    hosts[side]=$!
    until [[ $(readlink "/proc/${hosts[side]}/ns/net") != "$(readlink /proc/self/ns/net)" ]]; do
        sleep 0.05
    done
    ip link set "host$side" netns "${hosts[side]}"
    nsenter -t "${hosts[side]}" -n sh -e -c "
        ip link set lo up
        ip link set host$side up
        ip address add 10.9.0.$side/24 dev host$side
        ip address add fd09::$side/64 dev host$side nodad
        if ip link add link host$side name host$side.7 type vlan id 7 2>/dev/null; then
            ip link set host$side.7 up
            ip address add 10.9.7.$side/24 dev host$side.7
        fi"
done
on() {
    local host=${hosts[$1]}
    shift
    nsenter -t "$host" -n "$@"
}

# Without on(), because the killed process must be the program itself.
nsenter -t "${hosts[2]}" -n "$emulator" probe --answer '[::]:7002' >"$folder/answer" &
await ready "$folder/answer"
"$emulator" bridge wire1 wire2 --up.delay 20ms --down.delay 5ms --stats "$folder/run.json" \
    >"$folder/bridge" 2>&1 &
bridge=$!
await ready "$folder/bridge"
addresses=(10.9.0.2 '[fd09::2]')
if on 2 ip link show host2.7 >"$folder/said" 2>&1; then
    addresses+=(10.9.7.2)
else
    echo "not tested: VLANs, which this kernel does not have"
fi
for address in "${addresses[@]}"; do
    on 1 "$emulator" probe "$address:7002" --count 10 --rate 50 --json >"$folder/probe.json" ||
        fail "nothing passes to $address"
    jq -e '.answered == 10 and .there.delay_ms.min >= 20 and .back.delay_ms.min >= 5' \
        "$folder/probe.json" >"$folder/said" || fail "wrong delays to $address"
done
kill "$bridge"
wait "$bridge" || fail "the bridge ended with $?"
jq -e '.up.received >= 20 and .frames.a.undisturbed > 0 and .frames.a.oversized == 0 and
    .command == "bridge" and ([.up, .down][] |
    .received + .duplicated == .delivered + ([.dropped[]] | add) + .in_flight)' \
    "$folder/run.json" >"$folder/said" || fail "the statistics do not add up"

# Between two ends without traffic of a kernel, every frame arrives as it was sent.
if command -v python3 >"$folder/said"; then
    for side in 5 6; do
        ip link add "wire$side" type veth peer name "end$side"
        ip link set "wire$side" up
        ip link set "end$side" up
    done
    "$emulator" bridge wire5 wire6 --stats "$folder/frames.json" >"$folder/framed" 2>&1 &
    bridge=$!
    await ready "$folder/framed"
    python3 "$frames" end5 end6 >"$folder/ip_packets" 2>&1 || fail "frames do not pass as they are"
    kill "$bridge"
    wait "$bridge" || fail "the bridge of frames ended with $?"
    read -r up down <"$folder/ip_packets"
    # There are more frames, because kernels look for neighbours and groups.
    jq -e --argjson up "$up" --argjson down "$down" '.up.received >= $up and
        .down.received >= $down and .frames.a.lost_undisturbed + .frames.b.lost_undisturbed == 0 and
        ([.up, .down][] | .received == .delivered and .in_flight == 0)' \
        "$folder/frames.json" >"$folder/said" || fail "the statistics of frames do not add up"
else
    echo 'not tested: every kind of frame, which needs python3'
fi

# A host that is told sends packets that are short enough. Otherwise nothing passes.
# too_big OPTIONS: prints how many of 40 long questions got answers, for each family
too_big() {
    "$emulator" bridge wire1 wire2 --mtu 1280B --stats "$folder/mtu.json" "$@" \
        >"$folder/short" 2>&1 &
    bridge=$!
    await ready "$folder/short"
    answered=()
    for address in 10.9.0.2 '[fd09::2]'; do
        on 1 "$emulator" probe "$address:7002" --count 40 --rate 50 --size 1400 --wait 500ms \
            --json >"$folder/probe.json" || true
        answered+=("$(jq .answered "$folder/probe.json")")
    done
    kill "$bridge"
    wait "$bridge" || fail "the bridge with an MTU ended with $?"
}
too_big
[[ ${answered[*]} == '0 0' ]] || fail "without --icmp long packets pass: ${answered[*]}"
jq -e '.frames.a.told_too_big == 0 and .up.dropped.mtu >= 80' "$folder/mtu.json" \
    >"$folder/said" || fail "without --icmp it answers"
too_big --icmp
for count in "${answered[@]}"; do
    ((count >= 20)) || fail "with --icmp long packets do not come to pass: ${answered[*]}"
done
jq -e '.frames.a.told_too_big >= 2 and .frames.b.told_too_big >= 2 and
    .frames.a.told_too_big == .up.dropped.mtu' "$folder/mtu.json" \
    >"$folder/said" || fail "the answers are not counted"

# A kernel's bridge joins both interfaces elsewhere, too.
ip link add loop type bridge
for side in 3 4; do
    ip link add "wire$side" type veth peer name "port$side"
    ip link set "port$side" master loop
    ip link set "port$side" up
    ip link set "wire$side" up
done
ip link set loop up
ip address add 10.8.0.1/24 dev loop
"$emulator" bridge wire3 wire4 >"$folder/looped" 2>&1 &
bridge=$!
await ready "$folder/looped"
"$emulator" probe 10.8.0.2:7002 --count 3 --wait 100ms >"$folder/said" 2>&1 || true # asks by ARP
code=0
wait "$bridge" || code=$?
((code == 1)) || fail "a loop ended the bridge with $code"
grep -q 'a loop: ' "$folder/looped" || fail "the loop is not told"

# Without an interface nothing passes: the run ends, says why, and is not valid. ends_without WIRE
# REASON COMMAND...: the command takes an interface from a new bridge.
ends_without() {
    local wire=$1 reason=$2 side
    shift 2
    for side in 7 8; do
        ip link add "wire$side" type veth peer name "end$side"
        ip link set "wire$side" up
        ip link set "end$side" up
    done
    "$emulator" bridge wire7 wire8 --stats "$folder/lost.json" >"$folder/lost" 2>&1 &
    bridge=$!
    await ready "$folder/lost"
    "$@"
    code=0
    wait "$bridge" || code=$?
    ((code == 1)) || fail "$*: the bridge ended with $code, not 1"
    grep -q "NOT VALID: the interface $wire $reason" "$folder/lost" || fail "$*: no word of it"
    jq -e --arg start "the interface $wire $reason" '.valid == false and
        (.invalid_because[0] | startswith($start))' "$folder/lost.json" >"$folder/said" ||
        fail "$*: the statistics do not tell"
    for side in 7 8; do ip link delete "wire$side" 2>"$folder/said" || true; done
}
ends_without wire7 'has gone' ip link delete wire7
ends_without wire8 'has gone' ip link delete end8
ends_without wire7 'is down' ip link set wire7 down
ends_without wire8 'is down' ip link set wire8 down
code=0
"$emulator" between -- sh -c 'ip link delete eth0; exec sleep 1000' --- sleep 1000 \
    >"$folder/lost" 2>&1 || code=$?
((code == 1)) || fail "without a wire between ended with $code, not 1"
grep -q 'NOT VALID: the interface wire-a has gone' "$folder/lost" || fail 'between says nothing'

# A relay continues without its address, which may come back, but the run is not valid.
# loses_address WHERE OPTION...: a relay that listens there loses $address for a while.
loses_address() {
    local where=$1 relay
    rm -f "$folder/relay"
    "$emulator" "${@:2}" --stats "$folder/relay.json" >"$folder/relay" 2>&1 &
    relay=$!
    await ready "$folder/relay"
    ip address delete "$address" dev lo
    await "this machine has lost the address of $where" "$folder/relay"
    ip address add "$address" dev lo "${flags[@]}"
    await "the address of $where is back" "$folder/relay"
    kill "$relay"
    code=0
    wait "$relay" || code=$?
    ((code == 1)) || fail "$where: the relay ended with $code, not 1"
    jq -e '.valid == false and (.invalid_because[0] | startswith("this machine has lost"))' \
        "$folder/relay.json" >"$folder/said" || fail "$where: the statistics do not tell"
}
ip link set lo up
address=10.7.0.1/32
flags=()
ip address add "$address" dev lo
loses_address 10.7.0.1:7801 --listen-a 10.7.0.1:7801 --a 10.7.0.1 --listen-b 127.0.0.1:0
loses_address 10.7.0.1:7802 --listen 10.7.0.1:7802 --allow 10.7.0.0/16 --upstream 127.0.0.1:9
loses_address 10.7.0.1:7803 --link 1-2=127.0.0.1:0,10.7.0.1:7803,127.0.0.1,10.7.0.1
address=fd07::1/128
flags=(nodad)
ip address add "$address" dev lo nodad
loses_address '\[fd07::1\]:7804' --listen-a '[fd07::1]:7804' --a '[fd07::1]' --listen-b 127.0.0.1:0

code=0
"$emulator" bridge wire1 nosuch >"$folder/refused" 2>&1 || code=$?
((code == 3)) || fail "an interface that does not exist: $code"
grep -q "'ip link' lists" "$folder/refused" || fail "no cure where there is no interface"
code=0
setpriv --bounding-set -net_raw --inh-caps -net_raw "$emulator" bridge wire1 wire2 \
    >"$folder/denied" 2>&1 || code=$?
((code == 3)) || fail "without CAP_NET_RAW: $code"
grep -q 'CAP_NET_RAW' "$folder/denied" || fail "no cure without CAP_NET_RAW"
echo 'passed'
