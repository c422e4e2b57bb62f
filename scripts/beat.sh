#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# What is claimed of remote-proxy beyond the paper's algorithms: claims.csv,
# claims_quantiles.csv, sessions.csv.
# Options: scripts/experiment.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/experiment.sh" beat "$@"
