#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The programs that a script of ours has started end when the script is killed.
# Usage: session_lib_test.sh scripts/lib/session.sh FOLDER-WITH-THE-PROGRAMS
# shellcheck source=tests/e2e/script_lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/script_lib.sh"

cat >"$out/script.sh" <<EOF
set -euo pipefail
program=test bin=$programs
source $script
start_emulator $out --delay 1ms
peer 1 60 $out --task P1 2>$out/peer-1.log &
peers=(\$!)
peer 2 60 $out --task P1 2>$out/peer-2.log &
peers+=(\$!)
echo "\$emulator \${peers[*]}" >$out/started
wait
EOF
bash "$out/script.sh" >"$out/said" 2>&1 &
killed=$!
for _ in {1..400}; do
    [[ ! -s $out/started ]] || ! grep -qs 'session started' "$out/peer-2.log" || break
    sleep 0.05
done
read -ra started <"$out/started" || fail "the script did not start: $(cat "$out/said")"
((${#started[@]} == 3)) || fail 'it did not start three programs'
# A peer is the child of a timeout, which is what the script waits for.
readarray -t peers < <(ps -o pid= --ppid "${started[1]}" --ppid "${started[2]}" | tr -d " ")
((${#peers[@]} == 2)) || fail 'there are no two peers'
kill -KILL "$killed"
for _ in {1..400}; do
    left=0
    for process in "${started[@]}" "${peers[@]}"; do
        [[ $(ps -o stat= -p "$process" || true) == @(|Z*) ]] || left=$((left + 1))
    done
    ((left > 0)) || break
    sleep 0.05
done
kill -KILL "${started[@]}" "${peers[@]}" 2>/dev/null || true
((left == 0)) || fail "$left programs outlive the script"
echo passed
