#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Everything that the paper shows - Table 1, Fig. 6a, Fig. 6b, Fig. 7 - into one folder with one
# report. Options: scripts/experiment.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/experiment.sh" table1,fig6a,fig6b,fig7 "$@"
