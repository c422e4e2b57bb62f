// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hapnet::lab::metrics {

namespace {

constexpr double abrupt_n_per_ms = 0.5;

} // namespace

std::optional<ForceSteps> force_steps_of(std::span<const double> force, double tick_s)
{
    if (force.size() < 2) return std::nullopt;
    const double per_ms = 0.001 / tick_s;
    ForceSteps steps;
    double last_abrupt = 0.0;
    for (std::size_t i = 1; i < force.size(); ++i) {
        const double change = (force[i] - force[i - 1]) * per_ms;
        const double size = std::abs(change);
        steps.largest_n = std::max(steps.largest_n, size);
        if (size <= abrupt_n_per_ms) continue;
        if (change * last_abrupt < 0.0) steps.reversals += 1.0;
        last_abrupt = change;
    }
    return steps;
}

} // namespace hapnet::lab::metrics
