# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Trials with people over an emulated network: the program hapnet-study (docs/use/study.md).

Needs Python 3.11, which reads TOML."""
