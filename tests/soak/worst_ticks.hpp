// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace hapnet::soak {

/// The random scenes to search.
struct WorstTicks {
    std::uint64_t first = 0; // seed
    std::uint64_t count = 0;
    std::size_t bodies_max = 8; // movable ones
};

/// Counts the work of every tick of the scenes. Plays the 100 scenes with the most work in a tick
/// again, five times, and prints the most expensive ticks. The time of a tick is the least of the
/// five, so other load hardly counts.
void print_worst_ticks(const WorstTicks& asked);

} // namespace hapnet::soak
