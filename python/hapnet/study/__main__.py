# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""python3 -m hapnet.study is hapnet-study."""

import sys

from hapnet.study.program import main

sys.exit(main())
