// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/law.hpp"

#include "emulator/core/loss/trace.hpp"

namespace hapnet::emulator {

bool operator==(const TraceLoss& a, const TraceLoss& b)
{
    if (a.file != b.file) return false;
    return a.trace == b.trace || (a.trace && b.trace && *a.trace == *b.trace);
}

} // namespace hapnet::emulator
