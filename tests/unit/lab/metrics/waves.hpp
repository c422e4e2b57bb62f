// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace hapnet::lab::metrics {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double wave_tick_s = 0.001;

/// A sine of amplitude 1, sampled every millisecond.
[[nodiscard]] inline std::vector<double> sine(double hertz, double seconds, double phase = 0.0)
{
    std::vector<double> values(static_cast<std::size_t>(seconds / wave_tick_s + 0.5));
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = std::sin(2.0 * pi * hertz * static_cast<double>(i) * wave_tick_s + phase);
    }
    return values;
}

} // namespace hapnet::lab::metrics
