#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A datagram takes no more than MOST instructions in the emulator's core, if that is not 0, without
# a watch. Prints the cost of a watch.
# VALGRIND SPIN_PATH MOST
set -euo pipefail
valgrind=$1 spin=$2 most=$3
# shellcheck source=tests/cost/count_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/count_lib.sh"

unwatched=$(each 2000 12000 "$spin" unwatched)
watched=$(each 2000 12000 "$spin" watched)
echo "a datagram through a path of 160 ms: $unwatched instructions, $watched when watched"
((unwatched > 100)) || { echo "too few: nothing was done" && exit 1; }
((watched > unwatched)) || { echo "a watch counts nothing" && exit 1; }
((most == 0 || unwatched <= most)) || { echo "more than $most" && exit 1; }
