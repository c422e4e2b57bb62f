#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Fuzzes every parser with libFuzzer.
set -euo pipefail

usage="usage: scripts/fuzz.sh [SECONDS]
Builds the preset fuzz with Clang and fuzzes each parser for so many seconds (default 60). Needs
clang-14 and libclang-rt-14-dev. A crash leaves its input in build/fuzz/; add it to
tests/fuzz/corpus/TARGET/ with the fix. Exits 0 without a crash, 1 after one, 2 for a wrong
argument."

case ${1-} in
-h | --help) echo "$usage" && exit 0 ;;
esac
seconds=${1:-60}
if (($# > 1)) || [[ ! $seconds =~ ^[1-9][0-9]*$ ]]; then
    echo "fuzz: SECONDS is a whole number, 1 or more"$'\n'"$usage" >&2
    exit 2
fi
cd "$(dirname "$0")/.."

cmake --preset fuzz
cmake --build --preset fuzz

echo "canary: must be found within 60 s"
if build/fuzz/bin/fuzz_canary -max_total_time=60 -artifact_prefix=build/fuzz/ \
    >build/fuzz/canary.log 2>&1; then
    echo "the canary survived: the fuzzer would not notice a crash" >&2
    exit 1
fi

for binary in build/fuzz/bin/fuzz_*; do
    target=${binary#build/fuzz/bin/fuzz_}
    [[ $target != canary ]] || continue
    echo "$target: $seconds s"
    mkdir -p "build/fuzz/corpus/$target"
    "$binary" -max_total_time="$seconds" -max_len=512 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/$target-" \
        "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" 2>&1 |
        tee "build/fuzz/$target.log" | grep -E 'stat::number_of_executed|ERROR|SUMMARY' || true
    if [ "${PIPESTATUS[0]}" -ne 0 ]; then
        tail -n 20 "build/fuzz/$target.log" >&2
        exit 1
    fi
done
echo "no crash"
