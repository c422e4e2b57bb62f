// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/quantiles.hpp"

#include <algorithm>

namespace hapnet::lab::metrics {

std::optional<Quantiles> quantiles_of(std::vector<base::Duration> values)
{
    if (values.empty()) return std::nullopt;
    std::ranges::sort(values);
    // The smallest value that at least `percent` % of all values do not exceed.
    const auto nearest_rank = [&](std::size_t percent) {
        return values[(values.size() * percent + 99) / 100 - 1];
    };
    return Quantiles{nearest_rank(50), nearest_rank(99), values.back()};
}

} // namespace hapnet::lab::metrics
