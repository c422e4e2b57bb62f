// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/tick_times.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::records {
namespace {

using namespace std::chrono_literals;

TEST(TickTimes, AreWhenTicksWereDueButForThoseThatCameTicksLate)
{
    const base::TimePoint start{100s};
    record::Record record;
    const auto tick = [&](base::Duration due, base::Duration late) {
        record::TickRow row;
        row.due = start + due;
        row.late = late;
        record.ticks.push_back(row);
    };
    tick(-1ms, 0ms);
    tick(200us, 90us);
    tick(1200us, 13400us); // the loop stood still for this time
    tick(14200us, 500us);  // due before the last tick came
    tick(15200us, 60us);
    const std::vector<base::Duration> expected{200us, 14600us, 14700us, 15200us};
    EXPECT_EQ(tick_times(record, start), expected);
}

} // namespace
} // namespace hapnet::lab::records
