#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Fig. 7 of the paper: trajectories under 15 ms of jitter.
# Options: scripts/experiment.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/experiment.sh" fig7 "$@"
