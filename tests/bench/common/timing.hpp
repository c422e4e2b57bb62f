// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/clock.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::bench {

[[nodiscard]] inline std::int64_t clock_ns()
{
    return net::monotonic_now().time_since_epoch().count();
}

/// Returns a quantile of at least one value. Changes the order of the values.
[[nodiscard]] inline double quantile(std::vector<double>& values, double share)
{
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

/// The cost of reading the clock twice, ns, which is part of every measured time.
[[nodiscard]] inline double clock_cost_ns()
{
    std::vector<double> costs(1000);
    for (double& cost : costs) {
        const std::int64_t begin = clock_ns();
        cost = static_cast<double>(clock_ns() - begin);
    }
    return quantile(costs, 0.5);
}

} // namespace hapnet::bench
