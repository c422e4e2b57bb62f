# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Functions for the tests of our scripts. To be sourced with the script and the folder of the
# programs. Sets script, programs, and out, an empty folder that goes when the test ends.
set -euo pipefail

# shellcheck disable=SC2034 # used by those that source this
script=$(realpath "$1")
# shellcheck disable=SC2034
programs=$(realpath "$2")
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

fail() {
    echo "FAILED: $1" >&2
    exit 1
}

# validate_json FOLDER: all JSON in it is as its schema says, where jsonschema is there to look.
validate_json() {
    local code=0
    PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 \
        "$(dirname "${BASH_SOURCE[0]}")/schemas/schemas.py" "$programs" "$1" || code=$?
    ((code == 0 || code == 77)) || fail "JSON in $1"
}
