#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# scripts/real-time.sh plays real sessions, short ones here, and writes what it says; interrupted,
# it leaves no program behind. Usage: real_time_test.sh SCRIPT FOLDER-WITH-THE-PROGRAMS
set -euo pipefail
# shellcheck source=tests/e2e/script_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/script_lib.sh"

"$script" --quick --duration 3 --programs "$programs" --out "$out" 2>&1 | tee "$out/said"

[[ $(cut -d, -f1,2 "$out/real_time.csv") == $'algorithm,where
base,loopback
dead-reckoning,loopback' ]] || fail "the rows of real_time.csv"
# The first 1.5 s of the path, 160 ms apart: some millimetres, and as many in virtual time; but a
# busy machine may spoil a session, which then is not compared.
while IFS=, read -r algorithm _ mean _ _ virtual_mean _ _ difference valid _; do
    [[ $mean =~ ^[0-9]+\.[0-9]{4}$ && $mean != 0.0000 ]] || fail "mean of $algorithm: '$mean'"
    [[ $virtual_mean =~ ^[0-9]+\.[0-9]{4}$ && $virtual_mean != 0.0000 ]] ||
        fail "virtual mean of $algorithm: '$virtual_mean'"
    [[ $valid == true && -n $difference || $valid == false && -z $difference ]] ||
        fail "$algorithm is valid: $valid, and differs by '$difference'"
done < <(tail -n +2 "$out/real_time.csv")
grep -q 'real time against virtual time' "$out/said" || fail "no table was printed"
jq -e '.kind == "real-time" and (.real_time.sessions | length) == 2' "$out/manifest.json" \
    >/dev/null || fail "manifest.json"

# Two and three hands that turn a cube, each beside the same in virtual time.
for peers in 2 3; do
    "$script" --peers "$peers" --task T8 --delay 10ms --duration 4 --programs "$programs" \
        --out "$out/t8-$peers" >"$out/said-t8" 2>&1 || fail "T8 with $peers: $(cat "$out/said-t8")"
    table=$out/t8-$peers/real_time.csv
    IFS=, read -r algorithm where mean _ _ virtual_mean _ < <(tail -n 1 "$table")
    [[ $algorithm,$where == base,loopback ]] || fail "the row of T8 with $peers"
    [[ $mean =~ ^[0-9.]+$ && $virtual_mean =~ ^[0-9.]+$ ]] ||
        fail "T8 with $peers: mean '$mean', virtual '$virtual_mean'"
    [[ -s $out/t8-$peers/real-time/loopback/t8-$peers/peer-$peers.rec ]] || fail "no record of T8"
done

# As Ctrl-C does it: to all processes of a group.
set -m
"$script" --quick --duration 20 --programs "$programs" --out "$out/interrupted" >/dev/null 2>&1 &
group=$!
for _ in {1..100}; do
    [[ ! -s $out/interrupted/real-time/loopback/base/peer-1.out ]] || break
    sleep 0.1
done
kill -INT -- "-$group"
code=0
wait "$group" || code=$?
((code == 130)) || fail "interrupted, it exits $code and not 130"
! pgrep -g "$group" >/dev/null || fail "interrupted, it left programs behind"
