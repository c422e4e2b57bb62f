#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Quality of service: what a network must offer, beside the classes of ITU-T Y.1541.
# Options: scripts/experiment.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/experiment.sh" qos "$@"
