#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The units of systemd grant enough: the limits for real-time scheduling and locked memory without
# any capability, and the system calls and address families that the programs use.
# Usage: units_test.sh packaging/systemd FOLDER-WITH-THE-PROGRAMS
# shellcheck source=tests/e2e/script_lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/script_lib.sh"
units=$script
trap 'kill $(jobs -p) 2>/dev/null || true; wait; rm -rf "$out"' EXIT
chmod 755 "$out"
tested=0

# value_of UNIT KEY: the last value of a key; the values of a key that lists.
value_of() { sed -n "s/^$2=//p" "$units/$1.service"; }

# The programs as in a session, each after a word that is traced in its turn.
# as TRACED NAME WORD...: becomes the program NAME, under strace when NAME is TRACED.
as() {
    local before=()
    [[ $1 != "$2" ]] || before=(strace -D -f -qq -o "$out/calls") # -D: the child is the program
    exec "${before[@]}" "$programs/$2" "${@:3}"
}
# wait_until WORD...: until the command says yes, 10 s at most.
wait_until() {
    for _ in {1..200}; do
        ! "$@" || return 0
        sleep 0.05
    done
    return 1
}

# end_of PID NAME: waits for a program, which must end with 0. On a machine that stood still a peer
# ends at zero force with 1, but made its system calls all the same.
end_of() {
    local code=0
    wait "$1" || code=$?
    if ((code == 1)) && grep -q 'this program stood still' "$out/$2"; then return 0; fi
    ((code == 0)) || fail "$2 ends with $code: $(cat "$out/$2")"
}
is_read() { ! pgrep -f "strace .*$out/calls" >/dev/null; }

# session TRACED: two peers through an emulator, and the page.
session() {
    local traced=$1 ready='' pids=()
    rm -f "$out"/*.sock "$out/relay" "$out/web" "$out/calls"
    as "$traced" hapnet-emulator --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 --delay 2ms \
        --control "$out/emulator.sock" >"$out/relay" 2>&1 &
    pids+=($!)
    wait_until grep -qs '^ready' "$out/relay" ||
        fail "the emulator does not start: $(cat "$out/relay")"
    ready=$(grep '^ready' "$out/relay")
    [[ $ready =~ a=([^ ]+)\ b=([^ ]+) ]] || fail "no addresses: $ready"
    as "$traced" hapnet-peer --id 1 --remote "${BASH_REMATCH[1]}" --duration 2s \
        --control "$out/peer.sock" >"$out/peer-1" 2>&1 &
    pids+=($!)
    "$programs/hapnet-peer" --id 2 --remote "${BASH_REMATCH[2]}" --duration 2s >"$out/peer-2" 2>&1 &
    pids+=($!)
    wait_until test -S "$out/peer.sock" || fail "peer 1 does not start: $(cat "$out/peer-1")"
    if [[ -x $programs/hapnet-web ]]; then
        as "$traced" hapnet-web --port 0 --emulator "$out/emulator.sock" --peer "$out/peer.sock" \
            >"$out/web" 2>&1 &
        pids+=($!)
        wait_until grep -qs '^open' "$out/web" || fail "the page does not start: $(cat "$out/web")"
    fi
    end_of "${pids[1]}" peer-1
    end_of "${pids[2]}" peer-2
    kill "${pids[0]}" "${pids[@]:3}"
    end_of "${pids[0]}" relay
    [[ ! -v pids[3] ]] || end_of "${pids[3]}" web
    # The program can end before strace has written its last lines.
    wait_until is_read || fail "strace does not end"
}

# expanded NAME...: the system calls of these sets.
expanded() {
    local name
    for name in "$@"; do
        case $name in
        @*)
            local members
            readarray -t members < <(systemd-analyze syscall-filter "$name" |
                sed -n '2,$s/^ *\([@a-z0-9_-]*\)$/\1/p')
            expanded "${members[@]}"
            ;;
        ?*) echo "$name" ;;
        esac
    done
}
# allows UNIT PROGRAM: the unit allows each system call that the program has made.
allows() {
    local line allowed forbidden used
    allowed=$(for line in $(value_of "$1" SystemCallFilter); do
        [[ $line == '~'* ]] || expanded "$line"
    done | sort -u)
    forbidden=$(for line in $(value_of "$1" SystemCallFilter); do
        [[ $line != '~'* ]] || expanded "${line#'~'}"
    done | sort -u)
    allowed=$(comm -23 <(echo "$allowed") <(echo "$forbidden"))
    session "$2"
    used=$(sed -n 's/^[0-9]* *\([a-z0-9_]*\)(.*/\1/p' "$out/calls" | sort -u)
    (($(wc -l <<<"$used") > 20)) || fail "$2 was not traced"
    # The first one is that of strace itself.
    used=$(comm -23 <(echo "$used") <(echo "$allowed") | grep -vx execve || true)
    [[ -z $used ]] || fail "$1 forbids what $2 calls: ${used//$'\n'/ }"
    while read -r line; do
        [[ " $(value_of "$1" RestrictAddressFamilies) " == *" $line "* ]] ||
            fail "$1 forbids sockets of $line, which $2 makes"
    done < <(sed -n 's/^.* socket(\(AF_[A-Z0-9]*\),.*/\1/p' "$out/calls" | sort -u)
    tested=$((tested + 1))
}
if command -v strace >/dev/null && command -v systemd-analyze >/dev/null &&
    strace -f -qq -o "$out/calls" true 2>/dev/null; then
    allows hapnet-emulator hapnet-emulator
    allows hapnet-peer@ hapnet-peer
    [[ ! -x $programs/hapnet-web ]] || allows hapnet-web hapnet-web
else
    echo "not tested: system calls, which needs strace and systemd-analyze"
fi

# A program works with the limits of its unit, and without any capability.
# under_limits UNIT PROGRAM WORD...: prints its output.
under_limits() {
    prlimit --rtprio="$(value_of "$1" LimitRTPRIO)" \
        --memlock="$(value_of "$1" LimitMEMLOCK | sed s/infinity/unlimited/)" \
        setpriv --reuid 65534 --regid 65534 --clear-groups --bounding-set=-all --inh-caps=-all \
        --no-new-privs "$programs/$2" "${@:3}" >"$out/said" 2>&1 || true
    tested=$((tested + 1))
}
if ((EUID == 0)) && prlimit --rtprio=50 --memlock=unlimited true 2>/dev/null &&
    chrt --fifo 40 true 2>/dev/null &&
    setpriv --reuid 65534 --regid 65534 --clear-groups "$programs/hapnet-emulator" --version \
        >"$out/said" 2>&1; then
    under_limits hapnet-emulator hapnet-emulator --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 \
        --duration 100ms --stats -
    grep -q '"fifo":true,"locked_memory":true' <(tr -d ' \n' <"$out/said") ||
        fail "hapnet-emulator.service does not grant what it needs: $(cat "$out/said")"
    under_limits hapnet-peer@ hapnet-peer doctor
    grep -q 'SCHED_FIFO and locked memory are granted' "$out/said" ||
        fail "hapnet-peer@.service does not grant what it needs: $(cat "$out/said")"
else
    echo "not tested: limits, which needs root, SCHED_FIFO, and programs that others may run"
fi
((tested > 0)) || { echo "skipped: nothing could be tested here" && exit 77; }
echo "passed ($tested)"
