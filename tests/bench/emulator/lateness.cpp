// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/lateness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapnet::bench {

double microseconds(base::Duration duration) { return base::to_seconds(duration) * 1e6; }

double quantile_us(const std::vector<base::Duration>& sorted, double share)
{
    if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto rank = std::ceil(share * static_cast<double>(sorted.size()));
    return microseconds(sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1]);
}

Stalls stalls_in(std::vector<Departure> departures, base::Duration limit)
{
    std::erase_if(departures, [&](const Departure& one) { return one.late <= limit; });
    std::ranges::sort(departures, {}, &Departure::due);
    Stalls stalls;
    base::TimePoint begin{};
    base::TimePoint end = base::TimePoint::min();
    for (const auto& [due, late] : departures) {
        if (due > end) {
            ++stalls.count;
            begin = due;
        }
        end = std::max(end, due + late);
        stalls.longest = std::max(stalls.longest, end - begin);
    }
    return stalls;
}

} // namespace hapnet::bench
