#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Plays the ranges of fresh seeds by which the limits of Fig. 6 are published.
set -euo pipefail

usage="usage: scripts/limits_pool.sh --out DIR [--ranges N] [--set KEY=VALUE] [--jobs N]
Plays hapnet-lab run limits-pool by ranges of 40 seeds, each with a search of its own: N ranges, 10
when not given, about 10 minutes of a processor each. Writes DIR/range-FIRST.csv for each, and
prints docs/results/data/limits.json from them: the mean of the ranges' limits, with its 95 %
interval. Run again with the same --out after an interruption: nothing is played twice. Exits 0 when
done, 1 when stopped, 2 for an unknown argument."

refuse() {
    echo "limits_pool: $1"$'\n'"$usage" >&2
    exit 2
}

out='' ranges=10 options=()
while (($# > 0)); do
    case $1 in
    --out | --ranges | --set | --jobs)
        (($# > 1)) || refuse "$1: which value?"
        case $1 in
        --out) out=$(realpath -m "$2") ;;
        --ranges) ranges=$2 ;;
        *) options+=("$1" "$2") ;;
        esac
        shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
[[ -n $out ]] || refuse "--out: which directory?"
[[ $ranges =~ ^([2-9]|[1-9][0-9]+)$ ]] || refuse "--ranges: '$ranges' is no number from 2 on"

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh >&2
[[ -e build/release/build.ninja ]] || cmake --preset release -DHAPNET_TESTS=OFF >&2
cmake --build --preset release --target hapnet-lab >&2
first=200001 each=40
play() { # SEEDS FIRST_SEED
    build/release/bin/hapnet-lab run limits-pool "${options[@]}" --seeds "$1" \
        --set "first_seed=$2" --out "$out" >&2
}
for ((i = 0; i < ranges; ++i)); do
    range=$out/range-$((first + i * each)).csv
    [[ -e $range ]] && continue
    play "$each" $((first + i * each))
    cp "$out/limits.csv" "$range.partial"
    mv "$range.partial" "$range"
done
python3 scripts/limits_pool.py data "$out"
