// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/tick_times.hpp"

namespace hapnet::lab::records {

std::vector<base::Duration> tick_times(const record::Record& record, base::TimePoint start)
{
    constexpr base::Duration tick{std::chrono::milliseconds{1}};
    std::vector<base::Duration> times;
    times.reserve(record.ticks.size());
    for (const record::TickRow& row : record.ticks) {
        // The tick after a wake-up that was ticks late may be due before that wake-up.
        const bool is_even = row.late < tick && (times.empty() || row.due - start > times.back());
        const base::TimePoint time = is_even ? row.due : row.at();
        if (time >= start) times.push_back(time - start);
    }
    return times;
}

} // namespace hapnet::lab::records
