#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Calibrates the two thresholds of "usable" on two numbers of the paper (docs/design/metrics.md).
set -euo pipefail

usage="usage: scripts/calibrate.sh [--write] [--out DIR] [--seeds N] [--jobs N] [--quick]
Plays base at 160 ms of delay and at 93 % of random loss (hapnet-lab run calibration), writes
DIR/criteria.toml and says how it differs from scripts/criteria/paper.toml; --write replaces that
file, which the next build takes in. The other options are those of scripts/experiment.sh. Exits 0
when it is done, whether or not they differ."

write='' out='' options=()
while (($# > 0)); do
    case $1 in
    --write) write=yes && shift ;;
    --out | --seeds | --jobs)
        (($# > 1)) || { echo "calibrate: $1: which value?"$'\n'"$usage" >&2 && exit 2; }
        [[ $1 != --out ]] || out=$(realpath -m "$2")
        [[ $1 == --out ]] || options+=("$1" "$2")
        shift 2
        ;;
    --quick) options+=(--quick) && shift ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) echo "calibrate: unknown argument '$1'"$'\n'"$usage" >&2 && exit 2 ;;
    esac
done

cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=${out:-$PWD/results/calibration-$(date -u +%Y%m%dT%H%M%SZ)}
scripts/experiment.sh calibration "${options[@]}" --out "$out"
shipped=scripts/criteria/paper.toml
if cmp -s "$out/criteria.toml" "$shipped"; then
    echo "the same as $shipped"
else
    diff -u "$shipped" "$out/criteria.toml" || true
    [[ -z $write ]] || { cp "$out/criteria.toml" "$shipped" && echo "written: $shipped"; }
fi
