// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/loop.hpp"

namespace hapnet::lab::records {

Loop loop_of(const Side& side)
{
    using record::Phase;
    Loop loop;
    base::DurationSample late;
    base::TimePoint first{};
    base::TimePoint last{};
    for (const record::TickRow& row : side.ticks) {
        const bool counts = row.phase == Phase::running || row.phase == Phase::hands_off ||
                            row.phase == Phase::alone;
        if (!counts) continue;
        if (late.count() == 0) first = row.due;
        last = row.due;
        loop.missed += row.missed_before;
        late.add(row.late);
    }
    loop.ticks = late.count();
    if (last > first) {
        loop.rate_hz = static_cast<double>(loop.ticks - 1) / base::to_seconds(last - first);
    }
    loop.late = late.quantiles();
    return loop;
}

} // namespace hapnet::lab::records
