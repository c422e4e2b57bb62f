#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Everything that the paper shows - Table 1, Fig. 6a, Fig. 6b, Fig. 7 - into one folder with one
# report. With --all also what was not chosen and what moves the limits: readings of dead reckoning
# (velocity-rule, horizon, jitter-order), the delay of the path in the loss cells (path-delay),
# filters and hands (limits_by_convention.csv), networks (plane, any-network), two to five hands
# (many), and what a finer tick and more seeds buy (work-precision, work-precision-limits).
# scripts/long_tables.py prints their tables.
# Other options: scripts/experiment.sh --help.
set -euo pipefail
names=table1,fig6a,fig6b,fig7
options=()
for option in "$@"; do
    if [[ $option == --all ]]; then
        names+=,velocity-rule,horizon,jitter-order,path-delay,plane,any-network,many
        names+=,work-precision,work-precision-limits
        options+=(--conventions 10)
    else
        options+=("$option")
    fi
done
exec "$(dirname "${BASH_SOURCE[0]}")/experiment.sh" "$names" "${options[@]}"
