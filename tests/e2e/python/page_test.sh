#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The examples of docs/use/python.md, with Debian's Python. Exits 77 where a module is missing.
# Usage: page_test.sh REPOSITORY FOLDER-WITH-THE-PROGRAMS
set -euo pipefail
export PATH=/usr/bin:/bin PYTHONDONTWRITEBYTECODE=1
for module in pytest numpy pandas; do
    python3 -c "import $module" 2>/dev/null ||
        { echo "skipped: the module $module is missing (Debian: python3-$module)" && exit 77; }
done
exec "$1/tests/e2e/readme_test.sh" "$1/docs/use/python.md" "$2" 8
