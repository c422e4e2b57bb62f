#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A session with the copy of base in C takes at most 5 % more instructions than with base itself.
# VALGRIND SPIN_SESSION BASE_SO
set -euo pipefail
valgrind=$1 spin=$2 base=$3
# shellcheck source=tests/cost/count_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/count_lib.sh"

own=$(each 6 10 "$spin" base 2)
foreign=$(each 6 10 "$spin" "$base" 2)
echo "a second of a session: $own instructions with base, $foreign with its copy in C"
((own > 1000000)) || { echo "too few: nothing was played" && exit 1; }
((100 * foreign <= 105 * own))
