#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Sixteen flows cost a datagram no more than MOST instructions in the emulator's core, if that is
# not 0.
# VALGRIND SPIN_FLOWS MOST
set -euo pipefail
valgrind=$1 spin=$2 most=$3
# shellcheck source=tests/cost/count_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/count_lib.sh"

without=$(each 2000 12000 "$spin" 0)
with=$(each 2000 12000 "$spin" 16)
more=$((with - without))
echo "a frame through a path of 160 ms: $without instructions, $more more with 16 flows"
((without > 100)) || { echo "too few: nothing was done" && exit 1; }
((more > 0)) || { echo "flows cost nothing: they were not told apart" && exit 1; }
((most == 0 || more <= most)) || { echo "more than $most" && exit 1; }
