#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Runs the ```sh blocks of a README as they stand, on loopback, and fails when a command of one
# fails. Left out are blocks after a line "<!-- not run by readme_test: why -->".
# Usage: readme_test.sh README FOLDER-WITH-THE-PROGRAMS
set -euo pipefail

readme=$(realpath "$1")
programs=$(realpath "$2")
blocks_min=3
seconds_max=60 # for one block

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/build/release"
ln -s "$programs" "$folder/build/release/bin"
cd "$folder"

awk '
    /^<!-- not run by readme_test: / { left_out = 1; next }
    /^```sh$/ && !left_out { file = sprintf("block-%03d.sh", NR); next }
    /^```/ { file = ""; left_out = 0 }
    file { print > file }
' "$readme"

blocks=(block-*.sh)
if ((${#blocks[@]} < blocks_min)); then
    echo "only ${#blocks[@]} blocks to run in $readme; expected $blocks_min or more" >&2
    exit 1
fi

for block in "${blocks[@]}"; do
    line=$((10#${block//[^0-9]/}))
    printf '\n== the block at line %d of the README\n' "$line"
    begin=$SECONDS
    if ! timeout --kill-after 5 "$seconds_max" bash -e "$block"; then
        echo "FAILED: the block at line $line of the README" >&2
        tail -n 20 results/*/*.log 2>/dev/null >&2 || true
        exit 1
    fi
    printf -- '-- %d s\n' $((SECONDS - begin))
done
