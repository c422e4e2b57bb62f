#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# scripts/demo.sh refuses what it does not know, and lets two and three hands turn a cube, for a
# short time here. Usage: demo_test.sh SCRIPT FOLDER-WITH-THE-PROGRAMS
set -euo pipefail
# shellcheck source=tests/e2e/script_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/script_lib.sh"

refuses() {
    local code=0
    "$script" "$@" >"$out/said" 2>&1 || code=$?
    ((code == 2)) || fail "demo.sh $* exits $code and not 2"
}
"$script" --help >"$out/said" # whole: a script that writes to a closed pipe fails
grep -q -- '--scene turning' "$out/said" || fail "the help"
refuses --scene nowhere
grep -q 'write turning' "$out/said" || fail "what would be right is not said"
refuses --peers 9
refuses --scene
refuses --duration 5

for peers in 2 3; do
    folder=$out/$peers
    code=0
    "$script" --scene turning --peers "$peers" --duration 6 --programs "$programs" --out "$folder" \
        >"$out/said" 2>&1 || code=$?
    cat "$out/said"
    # The demo reports a busy machine, and leaves results all the same.
    ((code <= 1)) || fail "the demo of $peers hands exits $code"
    is_valid=true
    if ((code == 1)); then
        is_valid=false
        grep -q '^demo: the machine was too busy .* start the demo again\.$' "$out/said" ||
            fail "the demo of $peers hands exits 1 without its reason"
    fi
    [[ -s $folder/t8/report.html ]] || fail "no report of $peers hands"
    grep -q '^cube  ' "$out/said" || fail "no table of bodies of $peers hands"
    head -n 1 "$folder/t8/peer-1-bodies.csv" | grep -q '^time_s,tick,body,.*,orientation_w' ||
        fail "the rows of bodies"
    jq -e --argjson peers "$peers" --argjson is_valid "$is_valid" '.kind == "demo"
        and (.command | startswith("scripts/demo.sh "))
        and (.configuration.t8.peers | length) == $peers and .configuration.t8.task == "T8"
        and .seeds == {"peers": 1, "emulator": 42} and .wall_time_s >= 6
        and .valid == $is_valid and (.valid == ((.invalid_because | length) == 0))
        and (.host | type) == "object"' \
        "$folder/manifest.json" >/dev/null || fail "the manifest: $(<"$folder/manifest.json")"
    # The copies agree again by the end.
    jq -e '.bodies["0"].name == "cube" and .bodies["0"].turned_apart_deg.max >= 0
        and .settled_discrepancy_mm <= 0.1 and .settled_turned_apart_deg <= 0.1' \
        "$folder/t8/analysis.json" >/dev/null ||
        fail "the analysis of $peers hands: $(<"$folder/t8/analysis.json")"
    validate_json "$folder"
done
