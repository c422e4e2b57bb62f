#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Fig. 6a of the paper: the limits of delay and of jitter.
# Options: scripts/experiment.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/experiment.sh" fig6a "$@"
