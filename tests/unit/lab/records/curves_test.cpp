// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/curves.hpp"

#include "tests/unit/lab/records/recording.hpp"

namespace hapnet::lab::records {
namespace {

/// The cube at 1 mm per millisecond, the device at 1 N per second.
void move(record::TickRow& row, base::Duration time)
{
    row.cube = {{base::to_seconds(time), 0.0, 0.0}};
    row.device = {{0.0, base::to_seconds(time), 0.0}};
}

TEST(SessionCurves, HoldEveryTickOfTheSessionInMillimetresAndNewtons)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(-1s, 0s, Phase::countdown).ticks(0s, 50ms, Phase::running, move);
    b.session(1s).ticks(20ms, 50ms, Phase::running, move);
    const auto session = common_session(a.content(), b.content());
    ASSERT_TRUE(session);
    const SessionCurves curves = curves_of(*session);
    ASSERT_EQ(curves.cube_a_mm.size(), 50U);
    EXPECT_DOUBLE_EQ(curves.cube_a_mm[30].time_s, 0.030);
    EXPECT_DOUBLE_EQ(curves.cube_a_mm[30].value, 30.0);
    EXPECT_DOUBLE_EQ(curves.force_a_n[30].value, 0.030);
    ASSERT_EQ(curves.cube_b_mm.size(), 30U);
    EXPECT_DOUBLE_EQ(curves.cube_b_mm[0].time_s, 0.020);
    EXPECT_EQ(curves.force_b_n.size(), 30U);
}

TEST(SessionCurves, CompareBothCopiesAtEqualTimesOnTheClockOfA)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0s, 10ms, Phase::running, cube_at(0.010));
    b.session(1s).ticks(4ms, 10ms, Phase::running, cube_at(0.035));
    const auto session = common_session(a.content(), b.content());
    ASSERT_TRUE(session);
    const SessionCurves curves = curves_of(*session);
    ASSERT_EQ(curves.apart_mm.size(), 6U) << "before 4 ms there is nothing to compare with";
    EXPECT_DOUBLE_EQ(curves.apart_mm.front().time_s, 0.004);
    EXPECT_DOUBLE_EQ(curves.apart_mm.front().value, 25.0);
}

} // namespace
} // namespace hapnet::lab::records
