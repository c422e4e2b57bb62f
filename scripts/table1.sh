#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Table 1 of the paper at 160 ms of delay, and the closed-loop tasks beside it.
# Options: scripts/experiment.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/experiment.sh" table1 "$@"
