#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Scripts that miss the value of an option say so, with exit code 2, before they do anything.
# Usage: scripts_usage_test.sh REPOSITORY
set -euo pipefail
scripts=$1/scripts

# refuses NAME ARGUMENT...: scripts/NAME.sh does.
refuses() {
    local name=$1 code=0 said
    said=$("$scripts/$name.sh" "${@:2}" 2>&1) || code=$?
    ((code == 2)) || { echo "$* exits $code and not 2: $said" >&2 && exit 1; }
    [[ $said == "$name: --"*'?'* ]] || { echo "$* says $said" >&2 && exit 1; }
}
refuses package --out
refuses package --out ''
refuses bench web --json
refuses demo --out
refuses experiment fig7 --out
