// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/recorded_trace.hpp"
#include "tests/unit/lab/records/recording.hpp"

namespace hapnet::lab::records {
namespace {

/// A peer whose cube moves at 1 m/s from x = `from` at T0, and whose ticks are `late`.
Recording moving(int id, double from, base::Duration woken_late = 0ms)
{
    Recording recording{id};
    recording.session(6s); // 3 s hands on
    recording.ticks(0s, 3s, Phase::running, [&](record::TickRow& row, base::Duration time) {
        row.late = woken_late;
        row.cube = {{from + base::to_seconds(time + woken_late), 0.0, 0.0}};
        row.contact = {{-0.5, 0.0, 0.0}};
        row.device = {{-0.4, 0.0, 0.0}};
        row.touching = time >= 1s;
    });
    recording.ticks(3s, 6s, Phase::hands_off);
    recording.content().config["task"] = "T3";
    return recording;
}

virtual_time::Trace trace_between(Recording& a, Recording& b)
{
    const auto session = common_session(a.content(), b.content());
    EXPECT_TRUE(session);
    return trace_of(*session);
}

TEST(RecordedTrace, HoldsWhatBothSidesDidWhileBothWereRunning)
{
    auto a = moving(1, 0.0);
    auto b = moving(2, -0.16);
    const virtual_time::Trace trace = trace_between(a, b);
    EXPECT_EQ(trace.task, device::Task::t3);
    EXPECT_EQ(trace.tick, 1ms);
    EXPECT_EQ(trace.begin, 0ms);
    EXPECT_EQ(trace.overlap, 1.0);
    ASSERT_EQ(trace.sides[0].size(), 3000U);
    ASSERT_EQ(trace.sides[1].size(), 3000U);
    EXPECT_EQ(trace.sides[0][1500].body.x(), 1.5);
    EXPECT_EQ(trace.sides[1][1500].body.x(), 1.5 - 0.16);
    EXPECT_EQ(trace.sides[0][1500].on_body.x(), 0.5); // the reaction to the hand's force
    EXPECT_EQ(trace.sides[0][1500].on_hand.x(), -0.4);
    EXPECT_FALSE(trace.sides[0][999].touching);
    EXPECT_TRUE(trace.sides[0][1000].touching);
}

TEST(RecordedTrace, TakesBothSidesAtTheSameTimes)
{
    auto a = moving(1, 0.0);
    auto b = moving(2, 0.0, 300us);
    const virtual_time::Trace trace = trace_between(a, b);
    EXPECT_EQ(trace.begin, 300us); // when both had begun
    ASSERT_EQ(trace.sides[0].size(), 2999U);
    for (std::size_t i = 0; i < trace.sides[0].size(); ++i) {
        // Straight lines between rows of a straight motion: equal up to rounding.
        ASSERT_NEAR(trace.sides[0][i].body.x(), trace.sides[1][i].body.x(), 1e-12) << i;
    }
}

TEST(RecordedTrace, HasTheLowerIdFirstWhateverTheOrderOfTheRecords)
{
    auto a = moving(7, 0.0);
    auto b = moving(3, 1.0);
    EXPECT_EQ(trace_between(a, b).sides[0][0].body.x(), 1.0);
    EXPECT_EQ(trace_between(b, a).sides[0][0].body.x(), 1.0);
}

TEST(RecordedTrace, DoesNotCountTimeWithoutRowsAsOverlap)
{
    auto a = moving(1, 0.0);
    auto b = moving(2, 0.0);
    auto& rows = b.content().ticks;
    rows.erase(rows.begin() + 1000, rows.begin() + 1599); // 600 ms from row to row
    const virtual_time::Trace trace = trace_between(a, b);
    ASSERT_EQ(trace.sides[0].size(), 3000U);
    EXPECT_NEAR(trace.overlap, 0.8, 1e-12);
    EXPECT_NEAR(trace.sides[1][1300].body.x(), 1.3, 1e-12);
}

TEST(RecordedTrace, IsEmptyWhenOneSideNeverRan)
{
    auto a = moving(1, 0.0);
    Recording b{2};
    b.session(6s).ticks(0s, 6s, Phase::waiting);
    const virtual_time::Trace trace = trace_between(a, b);
    EXPECT_TRUE(trace.sides[0].empty());
    EXPECT_EQ(trace.overlap, 0.0);
}

} // namespace
} // namespace hapnet::lab::records
