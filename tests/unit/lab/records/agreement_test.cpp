// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/agreement.hpp"

#include "tests/unit/lab/records/recording.hpp"

namespace hapnet::lab::records {
namespace {

// Sums of some thousand numbers near 0.01 in double precision.
constexpr double rounding = 1e-12;

/// A cube that moves at `speed` m/s, delayed by `delay`.
auto moving(double speed, base::Duration delay)
{
    return [=](record::TickRow& row, base::Duration time) {
        row.cube = {{speed * base::to_seconds(time - delay), 0.0, 0.0}};
    };
}

TEST(Agreement, OfACubeSeenLaterByDIsItsSpeedTimesD)
{
    Recording a{1};
    Recording b{2};
    a.session(2s).ticks(0s, 2s, Phase::running, moving(0.1, 0ms));
    b.session(2s).ticks(0s, 2s, Phase::running, moving(0.1, 160ms));
    const auto x = analysis_of(a, b).agreement.discrepancy_x;
    ASSERT_TRUE(x);
    EXPECT_NEAR(x->mean, 0.016, rounding);
    EXPECT_NEAR(x->min, 0.016, rounding);
    EXPECT_NEAR(x->max, 0.016, rounding);
    EXPECT_NEAR(x->std, 0.0, rounding);
}

TEST(Agreement, SharesOutWhoTouchedWhileBothWereRunning)
{
    const auto touching = [](record::TickRow& row, base::Duration) { row.touching = true; };
    Recording a{1};
    Recording b{2};
    a.session(8ms).ticks(0ms, 4ms, Phase::running, touching).ticks(4ms, 8ms);
    a.ticks(8ms, 10ms, Phase::hands_off, touching);
    b.session(8ms).ticks(0ms, 3ms).ticks(3ms, 5ms, Phase::running, touching).ticks(5ms, 8ms);
    b.ticks(8ms, 10ms, Phase::hands_off, touching);
    const TouchShares shares = analysis_of(a, b).agreement.touching;
    EXPECT_EQ(shares.a, 0.5);
    EXPECT_EQ(shares.b, 0.25);
    EXPECT_EQ(shares.either, 0.625);
    EXPECT_EQ(shares.both, 0.125);
}

TEST(Agreement, HasTheMeanExtremesAndPopulationDeviationOfAllTicks)
{
    Recording a{1};
    Recording b{2};
    a.session(4ms);
    for (const auto& [time, x] : {std::pair{0ms, 1.0}, {1ms, -3.0}, {2ms, 1.0}, {3ms, -3.0}}) {
        a.ticks(time, time + 1ms, Phase::running, cube_at(x));
    }
    b.session(4ms).ticks(0ms, 4ms);
    const auto x = analysis_of(a, b).agreement.discrepancy_x;
    ASSERT_TRUE(x);
    EXPECT_EQ(x->mean, 2.0);
    EXPECT_EQ(x->min, 1.0);
    EXPECT_EQ(x->max, 3.0);
    EXPECT_EQ(x->std, 1.0);
}

TEST(Agreement, TakesBBetweenItsTicksOnAStraightLine)
{
    Recording a{1};
    Recording b{2};
    a.session(1ms).ticks(250us, 1ms, Phase::running, cube_at(0.0));
    b.session(1ms).ticks(0ms, 1ms, Phase::running, cube_at(0.0));
    b.ticks(1ms, 2ms, Phase::running, cube_at(1.0));
    EXPECT_EQ(analysis_of(a, b).agreement.discrepancy_x.value().mean, 0.25);
}

TEST(Agreement, ComparesBOnAsClockWhenTheyBootedApart)
{
    Recording a{1, "boot of A"};
    Recording b{2, "boot of B"};
    a.session({.start = start, .length = 1s, .remote_offset = 100s, .session = 1});
    b.session({.start = start + 100s, .length = 1s, .remote_offset = -100s, .session = 1});
    a.ticks(0s, 1s, Phase::running, moving(0.1, 0s));
    b.ticks(100s, 101s, Phase::running, moving(0.1, 100s));
    const Agreement agreement = analysis_of(a, b).agreement;
    EXPECT_EQ(agreement.scored, 1s);
    EXPECT_NEAR(agreement.discrepancy_x.value().max, 0.0, rounding);
}

TEST(Agreement, ScoresOnlyWhileBothAreRunning)
{
    Recording a{1};
    Recording b{2};
    a.session(10ms).ticks(0ms, 4ms).ticks(4ms, 10ms, Phase::hands_off);
    b.session(10ms).ticks(-5ms, 1ms, Phase::countdown, cube_at(9.0));
    b.ticks(1ms, 10ms, Phase::running, cube_at(2.0));
    const Agreement agreement = analysis_of(a, b).agreement;
    EXPECT_EQ(agreement.scored, 3ms);
    EXPECT_EQ(agreement.discrepancy_x.value().max, 2.0);
}

TEST(Agreement, IsUnknownWhileBHasNoTicksForMoreThan10Milliseconds)
{
    Recording a{1};
    Recording b{2};
    a.session(30ms).ticks(0ms, 30ms);
    b.session(30ms).ticks(0ms, 5ms).ticks(14ms, 15ms).ticks(25ms, 30ms);
    // 0 to 14 ms, where the gap is exactly 10 ms long, and 25 to 29 ms.
    EXPECT_EQ(analysis_of(a, b).agreement.scored, 20ms);
}

TEST(Agreement, IsUnknownWhenTheyNeverRanAtTheSameTime)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0s, 1s);
    b.session(1s).ticks(2s, 3s);
    const Agreement agreement = analysis_of(a, b).agreement;
    EXPECT_FALSE(agreement.discrepancy_x);
    EXPECT_EQ(agreement.scored, 0s);
    EXPECT_EQ(agreement.overlap, 0.0);
}

/// Pushes along y with this force in newtons. The motors give half of it.
auto pushing(double newtons)
{
    return [=](record::TickRow& row, base::Duration) {
        row.touching = true;
        row.contact = {{0.0, newtons, 0.0}};
        row.device = {{0.0, 0.0, 0.5 * newtons}};
    };
}

TEST(Agreement, ComparesTheStrengthOfForcesNotTheirDirection)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0ms, 4ms, Phase::running, pushing(-1.0));
    b.session(1s).ticks(0ms, 2ms, Phase::running, pushing(1.5));
    b.ticks(2ms, 4ms, Phase::running, pushing(1.0));
    const Agreement agreement = analysis_of(a, b).agreement;
    ASSERT_TRUE(agreement.contact_force_discrepancy);
    EXPECT_EQ(agreement.contact_force_discrepancy->mean, 0.25);
    EXPECT_EQ(agreement.contact_force_discrepancy->max, 0.5);
    ASSERT_TRUE(agreement.force_discrepancy);
    EXPECT_EQ(agreement.force_discrepancy->mean, 0.125) << "of what the devices were told";
    EXPECT_EQ(agreement.force_discrepancy->max, 0.25);
}

TEST(Agreement, OfForcesIsUnknownWhenTheyNeverTouchAtTheSameTime)
{
    Recording a{1};
    Recording b{2};
    a.session(10ms).ticks(0ms, 5ms, Phase::running, pushing(1.0)).ticks(5ms, 10ms);
    b.session(10ms).ticks(0ms, 5ms).ticks(5ms, 10ms, Phase::running, pushing(1.0));
    EXPECT_FALSE(analysis_of(a, b).agreement.force_discrepancy);
}

TEST(Agreement, AfterTheHandsLetGoCountsFrom2SecondsOnAndInAllDirections)
{
    const auto apart = [](record::TickRow& row, base::Duration time) {
        row.cube = time < 3s ? base::Position{{1.0, 1.0, 1.0}} : base::Position{{0.0, 3e-5, 4e-5}};
    };
    Recording a{1};
    Recording b{2};
    a.session(4s).ticks(0s, 1s).ticks(1s, 4s, Phase::hands_off);
    b.session(4s).ticks(0s, 1s).ticks(1s, 4s, Phase::hands_off, apart);
    EXPECT_DOUBLE_EQ(analysis_of(a, b).agreement.settled_discrepancy.value(), 5e-5);
}

TEST(Agreement, AfterTheHandsLetGoIsUnknownWhenTheTailEndsWithin2Seconds)
{
    Recording a{1};
    Recording b{2};
    a.session(3s).ticks(0s, 1s).ticks(1s, 3s, Phase::hands_off);
    b.session(3s).ticks(0s, 1s).ticks(1s, 3s, Phase::hands_off);
    EXPECT_FALSE(analysis_of(a, b).agreement.settled_discrepancy);
}

TEST(Agreement, OverlapIsTheShareOfTheSessionInWhichBothTakePart)
{
    Recording a{1};
    Recording b{2};
    a.session(10s).ticks(-1s, 0s, Phase::countdown).ticks(0s, 7s).ticks(7s, 10s, Phase::hands_off);
    b.session(10s).ticks(-1s, 0s, Phase::countdown).ticks(0s, 7s).ticks(7s, 8s, Phase::hands_off);
    b.ticks(8s, 10s, Phase::alone);
    EXPECT_DOUBLE_EQ(analysis_of(a, b).agreement.overlap, 0.8);
}

TEST(Agreement, OverlapIsWholeWhenNothingIsMissing)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0s, 1s);
    b.session(1s).ticks(0s, 1s);
    EXPECT_EQ(analysis_of(a, b).agreement.overlap, 1.0);
}

} // namespace
} // namespace hapnet::lab::records
