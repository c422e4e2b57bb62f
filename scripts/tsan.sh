#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Builds with ThreadSanitizer and runs every test under it: scripts/tsan.sh [CTEST OPTIONS].
set -euo pipefail
cd "$(dirname "$0")/.."

cmake --preset tsan
cmake --build --preset tsan
ctest --preset tsan -j "$(nproc)" "$@"
