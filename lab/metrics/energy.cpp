// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/energy.hpp"

#include <algorithm>
#include <cstddef>

namespace hapnet::lab::metrics {

std::optional<double> energy_taken_of(std::span<const std::span<const double>> work_of_hands)
{
    if (work_of_hands.empty()) return std::nullopt;
    std::size_t count = work_of_hands.front().size();
    for (const auto& work : work_of_hands) count = std::min(count, work.size());
    if (count == 0) return std::nullopt;
    double energy = 0.0;
    double least = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        double of_tick = 0.0;
        for (const auto& work : work_of_hands) of_tick += work[i];
        energy += of_tick;
        least = std::min(least, energy);
    }
    return std::max(0.0, -least);
}

} // namespace hapnet::lab::metrics
