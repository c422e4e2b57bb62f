// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/quantiles.hpp"

#include <algorithm>

namespace hapnet::base {

std::optional<Quantiles> DurationSample::quantiles() const
{
    if (values_.empty()) return std::nullopt;
    std::vector<Duration> sorted = values_;
    std::ranges::sort(sorted);
    const auto nearest_rank = [&](std::size_t per_mille) {
        return sorted[(sorted.size() * per_mille + 999) / 1000 - 1];
    };
    return Quantiles{nearest_rank(500), nearest_rank(900), nearest_rank(990), nearest_rank(999),
                     sorted.back()};
}

} // namespace hapnet::base
