#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The output of `hapnet-lab export --mcap` is read by @mcap/core and decoded by Foxglove's modules.
#   mcap_test.sh FOLDER BIN_DIR WORK_DIR
# npm fetches the modules into WORK_DIR, once.
set -euo pipefail
folder=$1
lab=$2/hapnet-lab
work=$3
mkdir -p "$work"
work=$(realpath "$work")

for program in node npm; do
    command -v "$program" >/dev/null || { echo "skipped: $program is missing" && exit 77; }
done
cp "$folder"/{package.json,package-lock.json,read.mjs} "$work"
cd "$work"
if ! cmp -s package-lock.json node_modules/.of; then
    timeout 60 npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1 ||
        { echo "skipped: npm cannot fetch the readers: $(tail -1 npm.log)" && exit 77; }
    cp package-lock.json node_modules/.of
fi
cat >kept.toml <<'EOF'
kind = "trajectories"
tasks = "T3"
duration = "6s"
algorithms = ["base"]
record = true
both.delay = "40ms"
EOF
rm -rf kept
"$lab" run kept.toml --out kept >run.log
records=(kept/records/base-T3/peer-{1,2}.rec)
"$lab" export "${records[0]}" >1.csv
"$lab" export "${records[0]}" --mcap >1.mcap
node read.mjs 1.mcap 1.csv 1
"$lab" export "${records[@]}" >both.csv
"$lab" export "${records[@]}" --mcap >both.mcap
node read.mjs both.mcap both.csv 1 2
# The reader would notice damage: one byte of a message's length is changed.
head -c 100000 1.mcap >cut.mcap
if node read.mjs cut.mcap 1.csv 1 >cut.log 2>&1; then
    echo "mcap_test: a file without its end was read" && exit 1
fi
