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
validate_json "$out"

# Two and three hands that turn a cube, each beside the same session in virtual time.
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

# An experiment of its own: two sessions, one of them of three hands.
cat >"$out/cells.toml" <<'experiment'
title = "two cells"
kind = "plane"
duration = "5s"
seeds = 1
algorithms = ["remote-proxy"]
tasks = ["T7"]
scene = "carry"
peers = [2, 3]
hands = ["firm", "relaxed"]
plane.delay = "20ms"
plane.jitter = "2ms"
plane.loss = "30%"
experiment
sweep=$out/sweep
play_sweep() {
    "$script" "$out/cells.toml" --attempts 1 --programs "$programs" --out "$sweep" "$@" \
        >"$out/said-sweep" 2>&1 || fail "the sweep: $(cat "$out/said-sweep")"
}
play_sweep --seeds 1
# column NAME: of each row of the sessions.
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) n = i; next }
    { print $n }' "$sweep/real_time_sessions.csv"; }
[[ $(column algorithm) == $'remote-proxy\nremote-proxy' && $(column peers) == $'2\n3' &&
    $(column hands) == $'firm/relaxed\nfirm/relaxed' ]] ||
    fail "the sessions: $(cat "$sweep/real_time_sessions.csv")"
grep -q '"\[both\]; loss = ""30%""; ' "$sweep/real_time_sessions.csv" || fail "the network"
grep -qE '^,remote-proxy,T7,firm/relaxed,3,carry,5,.*,mean_mm,' "$sweep/real_time_conditions.csv" ||
    fail "the conditions: $(cat "$sweep/real_time_conditions.csv")"
for result in "$sweep"/cells/*/attempt-1/result.json; do
    # The real mean is neither empty nor of other hands: it is within a factor of 3 of virtual time,
    # whatever the machine did.
    jq -e '.real.discrepancy_m.mean as $real | .virtual.discrepancy_m.mean as $virtual |
        $real > $virtual / 3 and $real < 3 * $virtual' "$result" >/dev/null || fail "$result"
    jq -e '.valid == (.invalid_because == [])' "$result" >/dev/null || fail "$result: valid"
done
[[ -z $(compgen -G "$sweep/cells/*/*/*.rec") ]] || fail "records were left behind"
jq -e '(.real_time.sessions | length) == 2' "$sweep/manifest.json" >/dev/null || fail "the manifest"
validate_json "$sweep"
# An interrupted session is played again, and no other; one that was not valid is not used.
read -r first second < <(echo "$sweep"/cells/*/attempt-1/result.json)
before=$(stat -c %Y%i "$first")
rm "$second"
play_sweep
[[ $(stat -c %Y%i "$first") == "$before" && -s $second ]] || fail "it did not go on where it was"
jq '.invalid_because = ["for the test"]' "$first" >"$out/invalid" && mv "$out/invalid" "$first"
play_sweep
grep -q 'for the test' "$sweep/real_time_sessions.csv" || fail "an invalid session is not marked"
grep -qE 'firm/relaxed,2,carry,.*,mean_mm,0,1,' "$sweep/real_time_conditions.csv" ||
    fail "an invalid session is used: $(cat "$sweep/real_time_conditions.csv")"
refused=$("$script" fig6a --out "$out/limits" --programs "$programs" 2>&1) &&
    fail "limits are played"
[[ $refused == *'kind = "plane"'* ]] || fail "limits: $refused"

# As Ctrl-C does: sends it to all processes of a group.
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
