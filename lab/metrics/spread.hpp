// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// How values lie, in their own unit; `std` is the population's.
struct Spread {
    double mean = 0.0;
    double min = 0.0;
    double max = 0.0;
    double std = 0.0;

    friend bool operator==(const Spread&, const Spread&) = default;
};

/// nullopt when there are no values.
[[nodiscard]] std::optional<Spread> spread_of(std::span<const double> values);

} // namespace hapnet::lab::metrics
