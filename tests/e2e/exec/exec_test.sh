#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A command with the emulator between it and the network, through pasta and through slirp4netns: as
# this user and, as root, as one who is not; how it ends, and what it says where something lacks.
# Usage: exec_test.sh FOLDER-WITH-THE-PROGRAMS
set -euo pipefail

emulator=$(realpath "$1")/hapnet-emulator
for tool in unshare setpriv jq; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool" && exit 77; }
done
# As root in a mount namespace of its own, with a tun device that users may open, as udev makes it.
if ((EUID == 0)) && [[ -z ${HAPNET_EXEC_TEST-} ]]; then
    unshare --mount true || { echo "skipped: no mount namespace here" && exit 77; }
    HAPNET_EXEC_TEST=yes exec unshare --mount "$0" "$@"
fi

folder=$(mktemp -d)
chmod 1777 "$folder"
cleanup() {
    # A command that fails here would end the cleanup and give the test its own exit code.
    # shellcheck disable=SC2046 # several words
    kill $(jobs -p) 2>/dev/null || true
    wait
    umount "$folder/dev" 2>/dev/null || true
    rm -rf "$folder"
}
trap cleanup EXIT
fail() {
    echo "FAILED: $1" >&2
    tail -n 20 "$folder"/{said,out,err} >&2
    exit 1
}
users=(self)
can_be_other=
if ((EUID == 0)); then
    mkdir "$folder/dev"
    mount -t tmpfs none "$folder/dev"
    if mknod -m 666 "$folder/dev/tun" c 10 200 && [[ -e /dev/net/tun ]] &&
        (: <>"$folder/dev/tun") 2>/dev/null; then
        mount --bind "$folder/dev/tun" /dev/net/tun
        can_be_other=yes
        users+=(nobody)
    fi
fi
# as USER COMMAND...
as() {
    local user=$1
    shift
    if [[ $user == nobody ]]; then
        setpriv --reuid 65534 --regid 65534 --clear-groups "$@"
    else
        "$@"
    fi
}

"$emulator" probe --answer 127.0.0.1:0 >"$folder/answer" &
for _ in {1..200}; do
    grep -q ready "$folder/answer" && break
    sleep 0.05
done
port=$(grep -o '[0-9]*$' < <(grep -o '127.0.0.1:[0-9]*' "$folder/answer"))

# A server of IPv6 on loopback, and a client of it. Without a port, there is no IPv6 or no Python.
cat >"$folder/server.py" <<'EOF'
import socket
server = socket.create_server(("::1", 0), family=socket.AF_INET6)
print("port", server.getsockname()[1], flush=True)
while True:
    client, _ = server.accept()
    client.sendall(b"here")
    client.close()
EOF
cat >"$folder/client.py" <<'EOF'
import socket, sys, time
begin = time.monotonic()
with socket.create_connection((sys.argv[1], int(sys.argv[2])), 20) as server:
    assert server.recv(4) == b"here"
print("answered after 42 ms or more" if time.monotonic() - begin >= 0.042 else "too early")
EOF
port6=
if command -v python3 >/dev/null; then
    python3 "$folder/server.py" >"$folder/port6" 2>"$folder/said" &
    for _ in {1..100}; do
        grep -q port "$folder/port6" && break
        kill -0 $! 2>/dev/null || break
        sleep 0.05
    done
    port6=$(sed -n 's/^port //p' "$folder/port6")
fi
chmod -R a+rX "$folder"

tested=0
ways_of_ipv6=0
tested_as_self=0
cd /
for user in "${users[@]}"; do
    for program in pasta slirp4netns; do
        code=0
        as "$user" "$emulator" exec --through "$program" -- sh -c 'exit 5' \
            >"$folder/out" 2>"$folder/err" || code=$?
        if ((code == 3)); then
            echo "not tested as $user: $program: $(tail -n 1 "$folder/err")"
            continue
        fi
        tested=$((tested + 1))
        [[ $user != self ]] || tested_as_self=$((tested_as_self + 1))
        echo "as $user through $program"
        ((code == 5)) || fail "the exit code is $code"
        grep -q "through $program" "$folder/err" || fail "it does not say what it goes through"
        as "$user" "$emulator" exec --through "$program" --up.delay 30ms --down.delay 12ms \
            --stats - -- sh -c "$emulator probe \$HAPNET_HOST:$port --count 10 --rate 50 --json \
                >&2; getent ahostsv4 host; tail -n 1 /etc/resolv.conf" \
            >"$folder/out" 2>"$folder/err" || fail "nothing comes back"
        sed -n '/^{$/,/^}$/p' "$folder/err" >"$folder/probe.json"
        sed -n '/^{$/,/^}$/p' "$folder/out" >"$folder/run.json"
        jq -e '.answered == 10 and .there.delay_ms.min >= 30 and .back.delay_ms.min >= 12' \
            "$folder/probe.json" >"$folder/said" || fail "wrong delays"
        grep -q '^10.0.2.2 ' "$folder/out" || fail "host is not a name"
        grep -q '^nameserver 10.0.2.3$' "$folder/out" || fail "no name server"
        jq -e --arg through "$program" '.command == "exec" and .through == $through and
            .up.received >= 10 and .frames.a.oversized == 0 and ([.up, .down][] |
            .received + .duplicated == .delivered + ([.dropped[]] | add) + .in_flight)' \
            "$folder/run.json" >"$folder/said" || fail "the statistics do not add up"
        if [[ -n $port6 ]] && grep -q 'and fd00::2 there' "$folder/err"; then
            as "$user" "$emulator" exec --through "$program" --up.delay 30ms --down.delay 12ms \
                --pcap "$folder/run.pcapng" -- sh -c "getent ahostsv6 host6;
                    python3 '$folder/client.py' \$HAPNET_HOST6 $port6" \
                >"$folder/out" 2>"$folder/err" || fail "nothing comes back over IPv6"
            grep -q '^fd00::2 ' "$folder/out" || fail "host6 is not a name"
            grep -q '^answered after 42 ms or more$' "$folder/out" || fail "wrong delay over IPv6"
            python3 -c "import ipaddress, sys
ends = b''.join(ipaddress.ip_address(a).packed for a in ('fd00::100', 'fd00::2'))
sys.exit(ends not in open('$folder/run.pcapng', 'rb').read())" ||
                fail "the capture has no packet of IPv6"
            rm "$folder/run.pcapng"
            ways_of_ipv6=$((ways_of_ipv6 + 1))
        fi
        # The same packets of the stream are lost for a seed; ARP and names take none of the draws.
        for run in 1 2; do
            as "$user" "$emulator" exec --through "$program" --up.loss 30% --seed 7 \
                --fates "$folder/fates.csv" -- "$emulator" probe "10.0.2.2:$port" --count 30 \
                --rate 300 --wait 200ms >"$folder/out" 2>"$folder/err" || true
            sed -n '/^up,/p' "$folder/fates.csv" | head -n 30 >"$folder/fates$run"
            rm "$folder/fates.csv"
        done
        cmp -s "$folder"/fates[12] || fail "the seed does not tell which packets are lost"
        (($(wc -l <"$folder/fates1") >= 30)) || fail "too few fates"
    done
done
((tested > 0)) || { echo "skipped: neither pasta nor slirp4netns works here" && exit 77; }
((tested_as_self > 0)) || { echo "passed ($tested ways), none of them as this user" && exit 0; }

((ways_of_ipv6 > 0)) || echo 'not tested: IPv6, for which this machine has no route'

# exec nests in itself, and with between either way.
"$emulator" exec -- "$emulator" exec -- sh -c 'getent ahostsv4 host; exit 7' \
    >"$folder/out" 2>"$folder/err" && code=0 || code=$?
((code == 7)) || fail "exec within exec: the exit code is $code"
grep -q '^10.0.2.2 ' "$folder/out" || fail "exec within exec: host is not a name"
"$emulator" exec -- "$emulator" between -- sh -c 'getent ahostsv4 b' --- sleep infinity \
    >"$folder/out" 2>"$folder/err" || fail "between does not run within exec"
grep -q '^10.0.0.2 ' "$folder/out" || fail "between within exec: b is not a name"
"$emulator" exec -- "$emulator" between -- getent ahostsv4 c --- sleep infinity --- sleep infinity \
    >"$folder/out" 2>"$folder/err" || fail "between of three does not run within exec"
grep -q '^10.0.0.3 ' "$folder/out" || fail "between of three within exec: c is not a name"
"$emulator" between -- "$emulator" exec --through slirp4netns -- getent ahostsv4 host --- \
    sleep infinity --- sleep infinity >"$folder/out" 2>"$folder/err" && code=0 || code=$?
if ((code == 3)) && grep -q 'slirp4netns: not installed' "$folder/err"; then
    echo 'not tested: exec within between, without slirp4netns'
else
    ((code == 0)) || fail "exec within between ended with $code"
    grep -q '^10.0.2.2 ' "$folder/out" || fail "exec within between: host is not a name"
fi

# A signal reaches the command, and its answer to it is the exit code. Nothing is left of a run that
# was killed.
# shellcheck disable=SC2016 # the command expands it
"$emulator" exec --duration 60s -- bash -c 'trap "exit 9" INT; echo on; while :; do
    sleep 0.05; done' >"$folder/out" 2>"$folder/err" &
run=$!
for _ in {1..400}; do
    grep -q on "$folder/out" && break
    sleep 0.05
done
kill -INT "$run"
code=0
wait "$run" || code=$?
((code == 9)) || fail "after SIGINT it ended with $code"
grep -q 'down (B to A)' "$folder/err" || fail "no summary after SIGINT"
"$emulator" exec -- sh -c 'echo on; exec sleep 7777' >"$folder/out" 2>"$folder/err" &
run=$!
for _ in {1..400}; do
    grep -q on "$folder/out" && break
    sleep 0.05
done
# The inits, and what they have started.
readarray -t children < <(ps -o pid= --ppid "$run")
readarray -t started < <(ps -o pid= --ppid "$(tr -d ' ' < <(IFS=, && echo "${children[*]}"))")
((${#started[@]} >= 2)) || fail "fewer than two processes: the command and its way out"
children+=("${started[@]}")
kill -KILL "$run"
for _ in {1..200}; do
    left=$(ps -o stat= -p "$(tr -d ' ' < <(IFS=, && echo "${children[*]}"))" | grep -vc Z || true)
    ((left > 0)) || break
    sleep 0.05
done
((left == 0)) || fail "$left processes are left of a run that was killed"

# refused CODE WORDS COMMAND...: expects this exit code, with these words on stderr.
refused() {
    local wanted=$1 words=$2 code=0
    shift 2
    "$@" >"$folder/out" 2>"$folder/err" || code=$?
    ((code == wanted)) || fail "$* ended with $code, not $wanted"
    grep -q -- "$words" "$folder/err" || fail "no '$words' on stderr"
}
refused 2 'a command is required' "$emulator" exec --delay 5ms
refused 2 'pasta' "$emulator" exec --through nothing -- true
refused 3 '/no/such/command' "$emulator" exec -- /no/such/command
refused 3 'apt-get install passt' env PATH=/no/such/folder "$emulator" exec -- /bin/true
refused 1 'NOT MET' "$emulator" exec --require 'up.received>=1000000' -- true
if [[ -n $can_be_other ]]; then
    umount /dev/net/tun
    mknod -m 600 "$folder/dev/closed" c 10 200
    mount --bind "$folder/dev/closed" /dev/net/tun
    refused 3 'chmod 666 /dev/net/tun' as nobody "$emulator" exec -- true
fi
echo "passed ($tested ways, $ways_of_ipv6 of them over IPv6 too)"
