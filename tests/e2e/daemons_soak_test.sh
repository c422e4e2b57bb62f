#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# scripts/soak.sh daemons in its short form: three daemons with keys through one emulator, one of
# which is killed and comes back; interrupted, it leaves no program behind and keeps what there is.
# Usage: daemons_soak_test.sh SCRIPT FOLDER-WITH-THE-PROGRAMS
set -euo pipefail
# shellcheck source=tests/e2e/script_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/script_lib.sh"

"$script" daemons --quick --programs "$programs" --out "$out/soak" 2>&1 | tee "$out/said"
grep -q 'every datagram is in one counter: yes' "$out/soak/table.txt" || fail "the emulator's row"
grep -Eq '^ +1 .* passed$' "$out/soak/table.txt" || fail "the row of the round"

# If two had been killed, this record would show only one.
code=0
"$programs/soak_daemons" round "$out/soak/round-1" 3 2 >"$out/said" || code=$?
((code == 1)) || fail "a kill that went unnoticed is not found: it exits $code"

# As Ctrl-C does: sends it to all processes of a group.
set -m
"$script" daemons --minutes 1 --programs "$programs" --out "$out/interrupted" >"$out/said" 2>&1 &
group=$!
for _ in {1..200}; do
    ! grep -qs 'session started' "$out/interrupted/round-1/peer-1.1.log" || break
    sleep 0.1
done
kill -INT -- "-$group"
code=0
wait "$group" || code=$?
((code == 130)) || fail "interrupted, it exits $code and not 130: $(cat "$out/said")"
! pgrep -g "$group" >/dev/null || fail "interrupted, it left programs behind"
grep -q round "$out/interrupted/table.txt" || fail "interrupted, it lost its table"
for id in 1 2 3; do
    record=$out/interrupted/round-1/peer-$id.1.rec
    "$programs/hapnet-lab" export --csv "$record" | tail -n 1 | grep -q . || fail "$record"
done
