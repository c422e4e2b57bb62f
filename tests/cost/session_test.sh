#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A tick of a session in virtual time, of one player with all that belongs to it, takes no more than
# MOST instructions, if that is not 0.
# VALGRIND PROGRAM ALGORITHM PLAYERS MOST
set -euo pipefail
valgrind=$1 program=$2 algorithm=$3 players=$4 most=$5
# shellcheck source=tests/cost/count_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/count_lib.sh"

# Both hands are on from 8 s to 16 s.
second=$(each 8 16 "$program" "$algorithm" "$players")
tick=$((second / (1000 * players)))
echo "$algorithm, $players players: $tick instructions a tick of a player"
((tick > 1000)) || { echo "too few: nothing was done" && exit 1; }
((most == 0 || tick <= most)) || { echo "more than $most" && exit 1; }
