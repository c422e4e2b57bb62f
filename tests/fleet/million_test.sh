#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Merges and reports many sessions, which were made and not played, and looks at the memory.
#   million_test.sh BIN_DIR MADE_SESSIONS WORK_DIR SESSIONS
set -euo pipefail
bin=$1
made=$2
work=$3
sessions=$4
most_kb=500000

fail() {
    echo "million_test: $1" >&2
    exit 1
}
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT

# 25 delays and 10 losses of 2 algorithms in 2 tasks are 1000 for each seed.
seeds=$(((sessions + 999) / 1000))
lines() {
    python3 - "$1" "$2" "$3" <<'EOF'
import sys
step, count, unit = float(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
print("[" + ", ".join(f'"{step * i:g}{unit}"' for i in range(count)) + "]")
EOF
}
cat >"$work/many.toml" <<EOF
kind = "plane"
title = "many"
duration = "5s"
seeds = $seeds
algorithms = ["base", "dead-reckoning"]
tasks = ["T1", "T3"]
[plane]
delay = $(lines 5 25 ms)
jitter = ["0ms"]
loss = $(lines 9 10 %)
EOF
# limited NAME COMMAND...: runs it, and says how long it took and how much memory.
limited() {
    local name=$1
    shift
    local begin=$SECONDS
    python3 - "$work/$name.kb" "$@" <<'EOF' >"$work/$name.log" ||
import resource, subprocess, sys
code = subprocess.call(sys.argv[2:])
with open(sys.argv[1], "w") as out:
    out.write(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss))
sys.exit(code)
EOF
        fail "$name failed: $(cat "$work/$name.log")"
    local kb
    kb=$(cat "$work/$name.kb")
    echo "million_test: $name: $((SECONDS - begin)) s, $((kb / 1000)) MB"
    ((kb <= most_kb)) || fail "$name took more than $((most_kb / 1000)) MB"
}
"$bin/hapnet-lab" plan "$work/many.toml" --out "$work/sweep" >"$work/plan.log"
"$made" "$work/sweep" >"$work/made.log" || fail "no sessions were made"
limited merge "$bin/hapnet-lab" merge "$work/sweep"
rows=$(($(wc -l <"$work/sweep/sessions.csv") - 1))
((rows >= sessions)) || fail "there are $rows rows, not $sessions"
(cd "$work/sweep" && b2sum --quiet -c B2SUMS) || fail "files and their sums differ"
limited report "$bin/hapnet-lab" report "$work/sweep"
[[ -s $work/sweep/report.html ]] || fail "there is no report.html"
echo "million_test: $rows rows of $(head -1 "$work/made.log")"
