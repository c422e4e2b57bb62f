// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/energy.hpp"

#include <algorithm>
#include <cstddef>

namespace hapnet::lab::metrics {

std::optional<double> energy_taken_of(std::span<const double> left_work,
                                      std::span<const double> right_work)
{
    const std::size_t count = std::min(left_work.size(), right_work.size());
    if (count == 0) return std::nullopt;
    double energy = 0.0;
    double least = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        energy += left_work[i] + right_work[i];
        least = std::min(least, energy);
    }
    return std::max(0.0, -least);
}

} // namespace hapnet::lab::metrics
