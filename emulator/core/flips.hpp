// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/verdict.hpp"

#include <cstddef>
#include <span>

namespace hapnet::emulator {

/// Inverts the bits that `flips` names. An empty datagram has none and stays as it is; two flips
/// of one place undo each other.
inline void apply(const Flips& flips, std::span<std::byte> bytes)
{
    if (bytes.empty()) return;
    for (std::size_t i = 0; i < flips.count; ++i) {
        const std::size_t bit = flips.places[i] % (bytes.size() * 8);
        bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    }
}

} // namespace hapnet::emulator
