// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/statistics.hpp"

#include "proto/base/figures/counters.hpp"

#include <numeric>

namespace hapnet::emulator {

std::uint64_t Counters::dropped_total() const
{
    return std::accumulate(dropped.values.begin(), dropped.values.end(), std::uint64_t{0});
}

void Statistics::add(const Statistics& other)
{
    base::add_counts<Counters>(*this, other);
    lateness.add(other.lateness);
    sojourn.add(other.sojourn);
}

bool Statistics::is_punctual(base::Duration budget) const
{
    const auto p99 = lateness.quantile(0.99);
    return !p99 || *p99 <= budget;
}

std::uint64_t Statistics::late_beyond(base::Duration budget) const
{
    return lateness.count_above(budget);
}

} // namespace hapnet::emulator
