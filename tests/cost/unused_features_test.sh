#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A world in which every tick is compiled and a scene that needs one of them costs at most 2 % more
# instructions than that tick alone, and no more than MOST, if that is not 0.
# VALGRIND WORLD ALONE PROFILE MOST
set -euo pipefail
valgrind=$1 world=$2 alone=$3 profile=$4 most=$5
# shellcheck source=tests/cost/count_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/count_lib.sh"

with=$(each 200 1200 "$world" "$profile")
without=$(each 200 1200 "$alone" "$profile")
echo "$profile: $with instructions a tick with every feature compiled in, $without without"
((without > 100)) || { echo "too few: nothing was done" && exit 1; }
((most == 0 || with <= most)) || { echo "more than $most" && exit 1; }
((100 * with <= 102 * without))
