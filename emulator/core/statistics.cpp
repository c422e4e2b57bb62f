// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/statistics.hpp"

#include <numeric>

namespace hapnet::emulator {

std::uint64_t Statistics::dropped_total() const
{
    return std::accumulate(dropped.values.begin(), dropped.values.end(), std::uint64_t{0});
}

void Statistics::add(const Statistics& other)
{
    received += other.received;
    delivered += other.delivered;
    duplicated += other.duplicated;
    corrupted += other.corrupted;
    reordered += other.reordered;
    in_flight += other.in_flight;
    ce_in += other.ce_in;
    ce_marked += other.ce_marked;
    ce_out += other.ce_out;
    bytes_in += other.bytes_in;
    bytes_out += other.bytes_out;
    for (const DropCause cause : drop_causes) dropped[cause] += other.dropped[cause];
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
