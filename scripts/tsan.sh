#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Runs every test under ThreadSanitizer.
set -euo pipefail

usage="usage: scripts/tsan.sh [CTEST_OPTION ...]
Builds the preset tsan and runs its tests. Exits 0 when all passed."

case ${1-} in
-h | --help) echo "$usage" && exit 0 ;;
esac
cd "$(dirname "$0")/.."

cmake --preset tsan
cmake --build --preset tsan
ctest --preset tsan -j "$(nproc)" "$@"
