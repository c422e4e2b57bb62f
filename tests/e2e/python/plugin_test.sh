#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The fixtures of pytest, and reading into numpy and pandas. Exits 77 where one is missing.
set -euo pipefail
for module in pytest numpy pandas; do
    python3 -c "import $module" 2>/dev/null ||
        { echo "skipped: the module $module is missing (Debian: python3-$module)" && exit 77; }
done
exec python3 -m pytest -q -p no:cacheprovider -p hapnet.pytest_plugin \
    "$(dirname "${BASH_SOURCE[0]}")/plugin_test.py"
