// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/spread.hpp"

#include <algorithm>

namespace hapnet::lab::metrics {

std::optional<Spread> spread_of(std::span<const double> values)
{
    if (values.empty()) return std::nullopt;
    const auto count = static_cast<double>(values.size());
    double sum = 0.0;
    for (const double value : values) sum += value;
    Spread spread{.mean = sum / count, .min = values.front(), .max = values.front()};
    double squares = 0.0; // squared distances to the mean: a second pass is more precise
    for (const double value : values) {
        spread.min = std::min(spread.min, value);
        spread.max = std::max(spread.max, value);
        squares += (value - spread.mean) * (value - spread.mean);
    }
    spread.std = std::sqrt(squares / count);
    return spread;
}

} // namespace hapnet::lab::metrics
