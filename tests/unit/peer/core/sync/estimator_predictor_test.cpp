// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/estimator_predictor.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer::estimator_predictor_test {
namespace {

constexpr double rounding = 1e-9;

/// Filters that trust the last two samples alone, so that numbers can be worked out by hand, and
/// outputs that may jump.
constexpr EstimatorPredictorOptions plain{.time_constant = base::Duration{0},
                                          .force_ahead_max = base::Duration{50ms},
                                          .force_slew_n_per_s = 1e6,
                                          .hip_slew_m_per_s = 1e3};

Copy<EstimatorPredictor> copy_with(const EstimatorPredictorOptions& options)
{
    return Copy<EstimatorPredictor>{EstimatorPredictor{options}, options.base.stale};
}

/// Two messages 1 ms apart, 5 ms on their way; the second arrives at 6 ms.
Copy<EstimatorPredictor> after_two(const EstimatorPredictorOptions& options, double first_n,
                                   double second_n)
{
    Copy copy = copy_with(options);
    copy.hear({.sequence = 1, .sent_ms = 0.0, .force_n = first_n, .hip_mm = 0.0}, 5.0);
    copy.hear({.sequence = 2, .sent_ms = 1.0, .force_n = second_n, .hip_mm = 0.2}, 6.0);
    return copy;
}

TEST(AlphaBeta, WeighsSamplesByTheTimeConstant)
{
    AlphaBeta filter{1e-3 / std::log(2.0)}; // a millisecond halves: alpha 3/4, beta 1/4
    filter.restart({0.0, 0.0, 0.0}, at_ms(0.0));
    filter.add({1.0, 0.0, 0.0}, at_ms(1.0));
    EXPECT_NEAR(filter.value().x, 0.75, rounding);
    EXPECT_NEAR(filter.slope().x, 250.0, 1e3 * rounding);
    filter.add({2.0, 0.0, 0.0}, at_ms(2.0)); // expected: 1
    EXPECT_NEAR(filter.value().x, 1.75, rounding);
    EXPECT_NEAR(filter.slope().x, 500.0, 1e3 * rounding);
    filter.add({9.0, 0.0, 0.0}, at_ms(2.0)); // no later than the last one
    filter.add({9.0, 0.0, 0.0}, at_ms(1.5));
    EXPECT_NEAR(filter.value().x, 1.75, rounding);
    filter.add({3.0, 0.0, 0.0}, at_ms(4.0)); // 2 ms: alpha 15/16, beta 9/16; expected: 2.75
    EXPECT_NEAR(filter.value().x, 2.75 + 0.25 * 15.0 / 16.0, rounding);
    EXPECT_NEAR(filter.slope().x, 500.0 + 0.25 * 9.0 / 16.0 / 2e-3, 1e3 * rounding);
}

TEST(AlphaBeta, FollowsARampWithoutLagAtUnevenTimes)
{
    AlphaBeta filter{10e-3};
    filter.restart({0.0, 0.0, 0.0}, at_ms(0.0));
    double ms = 0.0;
    for (int i = 0; i < 500; ++i) {
        ms += i % 7 == 0 ? 5.0 : 1.0;
        filter.add({1e-3 * ms, -2e-3 * ms, 0.0}, at_ms(ms));
    }
    EXPECT_NEAR(filter.value().x, 1e-3 * ms, rounding);
    EXPECT_NEAR(filter.slope().y, -2.0, 1e3 * rounding);
}

TEST(EstimatorPredictor, CarriesTheForceOnByTheAgeOfItsSample)
{
    // 100 N/s; sent at 1 ms.
    EXPECT_NEAR(after_two(plain, 1.0, 1.1).tick(6.0).remote_force.x(), 1.1 + 0.5, rounding);
    EXPECT_NEAR(after_two(plain, 1.0, 1.1).tick(8.0).remote_force.x(), 1.1 + 0.7, rounding);
    EstimatorPredictorOptions shorter = plain;
    shorter.force_ahead_max = 2ms;
    EXPECT_NEAR(after_two(shorter, 1.0, 1.1).tick(8.0).remote_force.x(), 1.1 + 0.2, rounding);
}

TEST(EstimatorPredictor, ReadsTheAgeFromTheSendersClockOrElseFromTheArrival)
{
    Copy copy = copy_with(plain);
    copy.clock = ClockEstimate{5s, {}};
    copy.hear({.sequence = 1, .sent_ms = 5000.0, .force_n = 1.0}, 5.0);
    copy.hear({.sequence = 2, .sent_ms = 5001.0, .force_n = 1.1}, 6.0);
    EXPECT_NEAR(copy.tick(8.0).remote_force.x(), 1.1 + 0.7, rounding);
    copy.clock.reset();
    EXPECT_NEAR(copy.tick(8.0).remote_force.x(), 1.1 + 0.2, rounding);
}

TEST(EstimatorPredictor, BridgesTheBeginningOfAHoleAndHoldsThroughALongOne)
{
    // Median delay 5 ms: full prediction up to 15 ms of age, none from 65 ms on; sent at 1 ms.
    const auto force_at = [](double now_ms) {
        return after_two(plain, 1.0, 1.02).tick(now_ms).remote_force.x(); // 20 N/s
    };
    EXPECT_NEAR(force_at(16.0), 1.02 + 0.02 * 15.0, rounding);
    EXPECT_NEAR(force_at(41.0), 1.02 + 0.02 * 40.0 * 0.5, rounding);
    EXPECT_NEAR(force_at(66.0), 1.02, rounding);
    EXPECT_NEAR(force_at(200.0), 1.02, rounding);
    EstimatorPredictorOptions abrupt = plain;
    abrupt.fade_within = base::Duration{0};
    EXPECT_NEAR(after_two(abrupt, 1.0, 1.02).tick(16.1).remote_force.x(), 1.02, rounding);
}

TEST(EstimatorPredictor, NeverPullsNorPushesMoreThanAContactCan)
{
    EXPECT_EQ(after_two(plain, 1.0, 0.8).tick(16.0).remote_force.x(), 0.0); // -200 N/s
    EXPECT_NEAR(after_two(plain, 1.0, 2.0).tick(16.0).remote_force.x(), force_max, rounding);
    EXPECT_NEAR(after_two(plain, -1.0, -2.0).tick(16.0).remote_force.x(), -force_max, rounding);
    // The received force is limited before it is filtered.
    EXPECT_NEAR(after_two(plain, 3.3, 1e30).tick(16.0).remote_force.x(), force_max, rounding);
    EXPECT_EQ(after_two(plain, 1.0, 0.0).tick(6.0).remote_force.x(), 0.0);
}

TEST(EstimatorPredictor, ChangesItsForceByTheSlewAtMost)
{
    EstimatorPredictorOptions slow = plain;
    slow.force_slew_n_per_s = 100.0; // 0.1 N a tick
    Copy copy = after_two(slow, 1.0, 1.0);
    EXPECT_NEAR(copy.tick(6.0).remote_force.x(), 1.0, rounding); // the first value is not filtered
    copy.hear({.sequence = 3, .sent_ms = 2.0, .force_n = 1.5}, 7.0);
    EXPECT_NEAR(copy.tick(7.0).remote_force.x(), 1.1, rounding);
    EXPECT_NEAR(copy.tick(8.0).remote_force.x(), 1.2, rounding);
}

TEST(EstimatorPredictor, StartsAnewWhenAHandTouchesOrLetsGo)
{
    Copy copy = after_two(plain, 1.0, 1.1);
    copy.hear({.sequence = 3, .sent_ms = 2.0, .touching = false, .force_n = 0.0}, 7.0);
    const Outcome off = copy.tick(7.0);
    EXPECT_EQ(off.remote_force, base::Force{});
    EXPECT_FALSE(off.remote_touching);
    copy.hear({.sequence = 4, .sent_ms = 3.0, .force_n = 0.8}, 8.0);
    EXPECT_NEAR(copy.tick(8.0).remote_force.x(), 0.8, rounding); // a jump without a slope
    EstimatorPredictorOptions patient = plain;
    patient.gap_max = 3ms;
    Copy gap = after_two(patient, 1.0, 1.1);
    gap.hear({.sequence = 9, .sent_ms = 8.0, .force_n = 0.8, .hip_mm = 7.0}, 13.0);
    const Outcome outcome = gap.tick(13.0);
    EXPECT_NEAR(outcome.remote_force.x(), 0.8, rounding);
    EXPECT_NEAR(outcome.remote_hip->x(), 7e-3, rounding);
}

TEST(EstimatorPredictor, IgnoresWhatIsOvertakenAndDuplicatesAndForgetsARun)
{
    for (const Stale stale : {Stale::drop, Stale::take}) {
        EstimatorPredictorOptions options = plain;
        options.base.stale = stale;
        Copy copy = after_two(options, 1.0, 1.1);
        copy.hear({.sequence = 2, .sent_ms = 1.0, .force_n = 1.1, .hip_mm = 0.2}, 6.5);
        copy.hear({.sequence = 1, .sent_ms = 0.0, .force_n = 1.0}, 6.5);
        const Outcome outcome = copy.tick(7.0);
        EXPECT_NEAR(outcome.remote_force.x(), 1.1 + 0.6, rounding);
        EXPECT_NEAR(outcome.remote_hip->x(), 1e-3 * (0.2 + 0.2 * 6.0), rounding);
    }
    Copy copy = after_two(plain, 1.0, 1.1);
    copy.remote.forget_state();
    copy.algorithm.forget();
    EXPECT_FALSE(copy.tick(7.0).remote_hip);
    copy.hear({.sequence = 1, .sent_ms = 900.0, .force_n = 0.5, .hip_mm = 4.0}, 905.0);
    const Outcome outcome = copy.tick(905.0);
    EXPECT_NEAR(outcome.remote_force.x(), 0.5, rounding);
    EXPECT_NEAR(outcome.remote_hip->x(), 4e-3, rounding);
}

TEST(EstimatorPredictor, ShowsTheHandWhereItIsByNowAndNotFurtherThanTheDelayAndABit)
{
    // 0.2 m/s, sent at 1 ms; median delay 5 ms, so at most 25 ms ahead, less with age.
    Copy copy = after_two(plain, 1.0, 1.0);
    EXPECT_NEAR(copy.tick(6.0).remote_hip->x(), 1e-3 * (0.2 + 0.2 * 5.0), rounding);
    EXPECT_NEAR(copy.tick(16.0).remote_hip->x(), 1e-3 * (0.2 + 0.2 * 15.0), rounding);
    EXPECT_NEAR(copy.tick(41.0).remote_hip->x(), 1e-3 * (0.2 + 0.2 * 25.0 * 0.5), rounding);
    EXPECT_NEAR(copy.tick(200.0).remote_hip->x(), 1e-3 * 0.2, rounding);
    EstimatorPredictorOptions slow = plain;
    slow.hip_slew_m_per_s = 0.1;
    Copy slewed = after_two(slow, 1.0, 1.0);
    const double first = slewed.tick(6.0).remote_hip->x();
    EXPECT_NEAR(slewed.tick(7.0).remote_hip->x(), first + 1e-4, rounding);
}

TEST(EstimatorPredictor, LeavesTheBodysPoseAlone)
{
    Copy copy = copy_with({});
    Copy base{BaseAlgorithm{}};
    for (int ms = 0; ms < 50; ++ms) {
        const Word word{.sequence = static_cast<std::uint32_t>(ms + 1),
                        .sent_ms = ms - 5.0,
                        .body_mm = 0.1 * ms,
                        .speed_m_per_s = 0.1,
                        .touching = ms % 20 < 15,
                        .force_n = 0.02 * ms};
        copy.hear(word, ms);
        base.hear(word, ms);
        std::ignore = copy.tick(ms);
        std::ignore = base.tick(ms);
        ASSERT_EQ(copy.world.hash(), base.world.hash()) << ms;
    }
}

} // namespace
} // namespace hapnet::peer::estimator_predictor_test
