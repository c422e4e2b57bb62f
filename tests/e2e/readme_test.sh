#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Runs the ```sh blocks of a Markdown page as they stand, on loopback, and fails when a command of
# one fails. Blocks after a line "<!-- not run by readme_test: why -->" are left out.
# Usage: readme_test.sh PAGE FOLDER-WITH-THE-PROGRAMS [FEWEST-BLOCKS-TO-RUN [TRIAL...]]
# TRIAL is a command of hapnet-emulator; when it exits with 3, the system refuses what the page is
# about, and nothing is run.
set -euo pipefail

page=$(realpath "$1")
programs=$(realpath "$2")
blocks_min=${3:-1}
trial=("${@:4}")
seconds_max=60 # for one block

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/build/release"
ln -s "$programs" "$folder/build/release/bin"
cd "$folder"

if ((${#trial[@]} > 0)); then
    code=0
    build/release/bin/hapnet-emulator "${trial[@]}" || code=$?
    ((code != 3)) || { echo "skipped: the system refuses it" && exit 77; }
fi

awk '
    /^<!-- not run by readme_test: / { left_out = 1; next }
    /^```sh$/ && !left_out { file = sprintf("block-%03d.sh", NR); next }
    /^```/ { file = ""; left_out = 0 }
    file { print > file }
' "$page"

shopt -s nullglob
blocks=(block-*.sh)
if ((${#blocks[@]} < blocks_min)); then
    echo "only ${#blocks[@]} blocks to run in $page; expected $blocks_min or more" >&2
    exit 1
fi

for block in "${blocks[@]}"; do
    line=$((10#${block//[^0-9]/}))
    printf '\n== %s, the block at line %d\n' "$page" "$line"
    begin=$SECONDS
    if ! timeout --kill-after 5 "$seconds_max" bash -e "$block"; then
        echo "FAILED: the block at line $line of $page" >&2
        tail -n 20 ./*.log results/*/*.log 2>/dev/null >&2 || true
        exit 1
    fi
    printf -- '-- %d s\n' $((SECONDS - begin))
done
