#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Scripts that miss a subject or a value, or get a wrong one, say so, with exit code 2, before they
# do anything.
# Usage: scripts_usage_test.sh REPOSITORY
set -euo pipefail
scripts=$1/scripts

# refuses NAME ARGUMENT...: scripts/NAME.sh asks for the value of an option.
refuses() {
    says "--*[?]*" "$@"
}

# says PATTERN NAME ARGUMENT...: scripts/NAME.sh refuses its arguments with words like these.
says() {
    local pattern=$1 name=$2 code=0 said
    said=$("$scripts/$name.sh" "${@:3}" 2>&1) || code=$?
    ((code == 2)) || { echo "${*:2} exits $code and not 2: $said" >&2 && exit 1; }
    # shellcheck disable=SC2053 # a pattern
    [[ $said == "$name: "$pattern ]] || { echo "${*:2} says $said" >&2 && exit 1; }
}
refuses package --out
refuses package --out ''
refuses bench web --json
refuses demo --out
refuses experiment fig7 --out
says "name a subject*usage: scripts/soak.sh SUBJECT*" soak
says "name a subject*" soak --quick
says "one subject, not 'scene' and 'all'*" soak scene all
says "SECONDS is a whole number*" fuzz --all
says "--only takes 'emulator'*" setup --only peer
says "--only takes 'emulator'*" setup --only emulator --test
