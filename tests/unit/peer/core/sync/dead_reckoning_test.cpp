// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// x^ = x_k + v (t - t_arrived,k + H), worked out by hand in millimetres and milliseconds: v in m/s
// is mm/ms.
#include "peer/core/sync/dead_reckoning.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::peer::dead_reckoning_test {
namespace {

constexpr double nm = 1e-6; // in millimetres: rounding
constexpr Horizon no_horizon{Horizon::Law::none, {}};

Copy<DeadReckoning> copy_with(const DeadReckoningOptions& options)
{
    return Copy<DeadReckoning>{DeadReckoning{options}, options.base.stale};
}

double predicted_mm(const Copy<DeadReckoning>& copy, double now_ms)
{
    return 1e3 * copy.algorithm.predicted(at_ms(now_ms)).value().x();
}

TEST(DeadReckoning, TakesConsecutiveMessagesToBeATickApartOrAsTheyArrivedOrAsTheyWereSent)
{
    const auto at_15_ms = [](VelocityRule rule) {
        Copy copy =
            copy_with({.velocity = rule, .horizon = {Horizon::Law::fixed, base::Duration{5ms}}});
        copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
        copy.hear({.sequence = 5, .sent_ms = 4.0, .body_mm = 1.2}, 12.0); // 2 to 4 are lost
        return predicted_mm(copy, 15.0); // 3 + 5 ms ahead of 1.2 mm
    };
    EXPECT_NEAR(at_15_ms(VelocityRule::nominal), 1.2 + (1.2 / 1.0) * 8.0, nm);
    EXPECT_NEAR(at_15_ms(VelocityRule::arrival), 1.2 + (1.2 / 2.0) * 8.0, nm);
    EXPECT_NEAR(at_15_ms(VelocityRule::sender), 1.2 + (1.2 / 4.0) * 8.0, nm);
}

TEST(DeadReckoning, LooksAheadByTheMeanDelayOrThisMessagesOwnOrAFixedTimeOrNotAtAll)
{
    const auto at_15_ms = [](Horizon horizon) {
        Copy copy = copy_with({.velocity = VelocityRule::sender, .horizon = horizon});
        copy.clock = ClockEstimate{5s, {}}; // lead of their clock
        copy.hear({.sequence = 1, .sent_ms = 5000.0, .body_mm = 0.0}, 10.0);
        copy.hear({.sequence = 5, .sent_ms = 5004.0, .body_mm = 1.2}, 12.0);
        return predicted_mm(copy, 15.0);
    };
    EXPECT_NEAR(at_15_ms({}), 1.2 + 0.3 * (3.0 + 9.0), nm); // 10 and 8 ms
    EXPECT_NEAR(at_15_ms({Horizon::Law::packet_age, {}}), 1.2 + 0.3 * (3.0 + 8.0), nm);
    EXPECT_NEAR(at_15_ms({Horizon::Law::fixed, 20ms}), 1.2 + 0.3 * (3.0 + 20.0), nm);
    EXPECT_NEAR(at_15_ms(no_horizon), 1.2 + 0.3 * 3.0, nm);
}

TEST(DeadReckoning, LooksAheadByNoDelayWhileTheClockIsInDoubt)
{
    for (const Horizon horizon : {Horizon{}, Horizon{Horizon::Law::packet_age, {}}}) {
        Copy copy = copy_with({.velocity = VelocityRule::sender, .horizon = horizon});
        copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
        copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 0.3}, 11.0);
        EXPECT_EQ(copy.algorithm.horizon(), 10ms);
        copy.clock.reset();
        copy.hear({.sequence = 3, .sent_ms = 2.0, .body_mm = 0.6}, 12.0);
        EXPECT_EQ(copy.algorithm.horizon(), 0ms);
        copy.clock = ClockEstimate{};
        copy.hear({.sequence = 4, .sent_ms = 3.0, .body_mm = 0.9}, 13.0);
        EXPECT_EQ(copy.algorithm.horizon(), 10ms);
    }
}

TEST(DeadReckoning, CountsAnOvertakenMessageInTheDelayAndNowhereElse)
{
    Copy copy = copy_with({});
    copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
    copy.hear({.sequence = 3, .sent_ms = 2.0, .body_mm = 0.6}, 11.0);
    copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 0.3}, 12.0); // late
    copy.hear({.sequence = 3, .sent_ms = 2.0, .body_mm = 0.6}, 13.0); // a duplicate
    EXPECT_NEAR(base::to_seconds(copy.algorithm.horizon()), 1e-3 * (10 + 9 + 11 + 11) / 4.0, 1e-9);
    EXPECT_NEAR(predicted_mm(copy, 11.0), 0.6 + 0.6 * 10.25, nm);
}

TEST(DeadReckoning, LooksAheadByHalfTheRoundTripWhateverTheAsymmetryOfThePath)
{
    ClockSync clock; // equal clocks; 20 ms there, 60 ms back
    clock.add({at_ms(0.0), at_ms(20.0), at_ms(20.0), at_ms(80.0)});
    Copy copy = copy_with({});
    copy.clock = clock.estimate();
    copy.hear({.sent_ms = 20.0}, 80.0);
    EXPECT_EQ(copy.algorithm.horizon(), 40ms);
}

TEST(DeadReckoning, WithoutAClockLooksAheadFromTheArrivalOnly)
{
    Copy copy = copy_with({});
    copy.clock.reset();
    copy.hear({.sequence = 1, .body_mm = 0.0}, 10.0);
    copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 0.3}, 11.0);
    EXPECT_NEAR(predicted_mm(copy, 13.0), 0.3 + 0.3 * 2.0, nm);
}

TEST(DeadReckoning, DoesNotBelieveADelayThatNoNetworkHas)
{
    Copy copy = copy_with({.velocity = VelocityRule::nominal});
    copy.hear({.sequence = 1, .sent_ms = 0.0}, 10.0);
    copy.hear({.sequence = 2, .sent_ms = 1e7, .body_mm = 0.3}, 11.0); // a damaged stamp
    EXPECT_EQ(copy.algorithm.horizon(), 10ms);
    copy.hear({.sequence = 3, .sent_ms = -1e7, .body_mm = 0.6}, 12.0);
    EXPECT_EQ(copy.algorithm.horizon(), 10ms);
    EXPECT_TRUE(base::is_finite(copy.algorithm.predicted(at_ms(12.0)).value()));
}

TEST(DeadReckoning, TwoMessagesThatArriveAtOnceAreTwoTicksApartFromTheOneBefore)
{
    const auto at_12_ms = [](VelocityRule rule) {
        Copy copy = copy_with({.velocity = rule, .horizon = {Horizon::Law::fixed, 10ms}});
        copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
        copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 0.1}, 12.0);
        copy.hear({.sequence = 3, .sent_ms = 2.0, .body_mm = 0.4}, 12.0);
        return predicted_mm(copy, 12.0);
    };
    EXPECT_NEAR(at_12_ms(VelocityRule::nominal), 0.4 + 0.3 * 10.0, nm);
    EXPECT_NEAR(at_12_ms(VelocityRule::sender), 0.4 + 0.3 * 10.0, nm);
    // No time passed between the last two, so the earlier velocity is kept.
    EXPECT_NEAR(at_12_ms(VelocityRule::arrival), 0.4 + (0.1 / 2.0) * 10.0, nm);
}

TEST(DeadReckoning, StaleMessagesThatAreTakenThrowTheNominalVelocityBackAndNotTheSenders)
{
    const auto after = [](VelocityRule rule, std::uint32_t sequence, double sent_ms, double mm) {
        Copy copy = copy_with({.velocity = rule,
                               .horizon = {Horizon::Law::fixed, 10ms},
                               .base = {.stale = Stale::take}});
        copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
        copy.hear({.sequence = 3, .sent_ms = 2.0, .body_mm = 0.6}, 11.0);
        copy.hear({.sequence = sequence, .sent_ms = sent_ms, .body_mm = mm}, 12.0);
        return predicted_mm(copy, 12.0);
    };
    EXPECT_NEAR(after(VelocityRule::nominal, 2, 1.0, 0.3), 0.3 - 0.3 * 10.0, nm);
    EXPECT_NEAR(after(VelocityRule::sender, 2, 1.0, 0.3), 0.3 + 0.3 * 10.0, nm);
    // A duplicate: no motion in a tick, or no time passed.
    EXPECT_NEAR(after(VelocityRule::nominal, 3, 2.0, 0.6), 0.6, nm);
    EXPECT_NEAR(after(VelocityRule::sender, 3, 2.0, 0.6), 0.6 + 0.3 * 10.0, nm);
}

TEST(DeadReckoning, AMessageWithoutABodySaysThatItStands)
{
    Copy copy = copy_with({});
    EXPECT_FALSE(copy.algorithm.predicted(at_ms(0.0)));
    copy.hear({.sequence = 1, .has_body = false}, 10.0);
    EXPECT_FALSE(copy.algorithm.predicted(at_ms(10.0)));
    copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 1.0}, 11.0);
    copy.hear({.sequence = 3, .sent_ms = 2.0, .body_mm = 1.5}, 12.0);
    EXPECT_GT(predicted_mm(copy, 12.0), 2.0);
    copy.hear({.sequence = 4, .sent_ms = 3.0, .has_body = false}, 13.0);
    EXPECT_NEAR(predicted_mm(copy, 20.0), 1.5, nm);
}

TEST(DeadReckoning, HasNoVelocityAfterAGapAndAfterARestart)
{
    Copy copy = copy_with({});
    copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
    copy.hear({.sequence = 251, .sent_ms = 250.0, .body_mm = 1.0}, 260.0);
    EXPECT_NEAR(predicted_mm(copy, 260.0), 1.0 + 1.0 * 10.0, nm); // the longest gap with a velocity
    copy.hear({.sequence = 502, .sent_ms = 501.0, .body_mm = 50.0}, 511.0);
    EXPECT_NEAR(predicted_mm(copy, 520.0), 50.0, nm);
    copy.hear({.sequence = 503, .sent_ms = 502.0, .body_mm = 50.3}, 512.0);
    EXPECT_NEAR(predicted_mm(copy, 512.0), 50.3 + 0.3 * 10.0, nm);

    copy.remote.forget_state();
    copy.algorithm.forget();
    EXPECT_FALSE(copy.algorithm.predicted(at_ms(513.0)));
    EXPECT_EQ(copy.algorithm.horizon(), 0ms);
    copy.hear({.sequence = 1, .sent_ms = 503.0, .body_mm = -40.0}, 513.0);
    EXPECT_NEAR(predicted_mm(copy, 520.0), -40.0, nm);
}

TEST(DeadReckoning, IsBoundedInSpeedInLeadAndInTime)
{
    const auto lead_mm = [](const DeadReckoningOptions& options, double now_ms) {
        Copy copy = copy_with(options);
        copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
        copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 500.0}, 11.0); // 500 m/s
        return predicted_mm(copy, now_ms) - 500.0;
    };
    EXPECT_NEAR(lead_mm({.horizon = no_horizon}, 12.0), 100.0, nm);
    EXPECT_NEAR(lead_mm({.horizon = no_horizon, .speed_max_m_per_s = 2.0}, 14.0), 6.0, nm);
    EXPECT_NEAR(lead_mm({}, 200.0), 1000.0, nm);
    EXPECT_NEAR(lead_mm({.lead_max_m = 0.02}, 200.0), 20.0, nm);
    EXPECT_NEAR(lead_mm({.ahead_max = 12ms, .speed_max_m_per_s = 1.0}, 200.0), 12.0, nm);
}

TEST(DeadReckoning, StandsForThePlaceWhileOnlyTheOtherHandTouchesAndNotForItsVelocityOrForce)
{
    Copy copy = copy_with({.horizon = {Horizon::Law::fixed, 10ms}});
    copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 0.0}, 10.0);
    copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 0.3, .speed_m_per_s = 0.25}, 11.0);
    for (const double ms : {11.0, 12.0, 13.0}) { // silent since
        const Outcome outcome = copy.tick(ms);
        EXPECT_NEAR(copy.x_mm(), 0.3 + 0.3 * (ms - 11.0 + 10.0), nm);
        EXPECT_EQ(copy.speed(), 0.25);
        EXPECT_TRUE(outcome.remote_touching);
    }
    std::ignore = copy.tick(311.0, away, 0.0); // stale: no message counts
    EXPECT_LT(copy.x_mm(), 0.3 + 0.3 * 13.0);

    Copy both = copy_with({});
    scene::World expected = paper_world();
    both.hear({.body_mm = 5.0, .force_n = -0.5}, 0.0);
    both.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 9.0, .force_n = -0.5}, 1.0);
    for (int ms = 1; ms < 20; ++ms) {
        std::ignore = both.tick(ms, pushing_hip(0.004));
        tick(expected, pushing_hip(0.004), -0.5);
        ASSERT_EQ(both.world.hash(), expected.hash()) << ms;
    }
}

TEST(DeadReckoning, IsWhereABodyAtRestSettles)
{
    Copy copy = copy_with({.horizon = {Horizon::Law::fixed, 10ms},
                           .base = {.settle_after = 2ms, .settle_within = 0ms}});
    copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 4.0, .touching = false}, 0.0);
    copy.hear({.sequence = 2, .sent_ms = 1.0, .body_mm = 4.1, .touching = false}, 1.0);
    for (const double ms : {1.0, 2.0, 3.0}) std::ignore = copy.tick(ms);
    EXPECT_NEAR(copy.x_mm(), 4.1 + 0.1 * 12.0, nm);
}

TEST(DeadReckoning, BlendsANewPredictionInByProjectingBothVelocities)
{
    Copy copy = copy_with({.horizon = no_horizon, .blend_within = 4ms});
    copy.hear({.sequence = 1, .sent_ms = 0.0, .body_mm = 8.0}, 0.0);
    std::ignore = copy.tick(0.0); // from the own body, at rest at 0: a quarter of the way
    EXPECT_NEAR(copy.x_mm(), 2.0, nm);
    std::ignore = copy.tick(1.0); // without a message the same blend goes on
    EXPECT_NEAR(copy.x_mm(), 4.0, nm);
    copy.hear({.sequence = 2, .sent_ms = 2.0, .body_mm = 8.8},
              2.0);               // 0.8 mm/ms by the nominal rule
    std::ignore = copy.tick(2.0); // anew from 4 mm and no velocity
    const double onward = 4.0 + 0.25 * 0.8 * 1.0;
    EXPECT_NEAR(copy.x_mm(), onward + 0.25 * (8.8 - onward), nm);
    const double before = copy.x_mm();
    std::ignore = copy.tick(3.0);
    const double further = 4.0 + 0.5 * 0.8 * 2.0;
    EXPECT_NEAR(copy.x_mm(), further + 0.5 * (9.6 - further), nm);
    EXPECT_GT(copy.x_mm(), before);
    for (int ms = 4; ms < 8; ++ms) std::ignore = copy.tick(ms);
    EXPECT_NEAR(copy.x_mm(), 8.8 + 0.8 * 5.0, nm); // taken over
}

TEST(OneWayDelay, IsTheMeanOfTheFirstMessagesAndThenForgetsOldOnes)
{
    OneWayDelay delay{4};
    EXPECT_EQ(delay.mean(), 0ms);
    for (const auto d : {10ms, 20ms, 30ms}) delay.add(d);
    EXPECT_EQ(delay.mean(), 20ms);
    delay.add(40ms);
    EXPECT_EQ(delay.mean(), 25ms);
    delay.add(45ms);
    EXPECT_EQ(delay.mean(), 30ms); // a quarter of the difference
    for (int i = 0; i < 200; ++i) delay.add(-1ms);
    EXPECT_EQ(delay.mean(), 0ms); // clocks may err; nothing arrives before it was sent
}

TEST(OneWayDelay, HasAMedianThatOneOutlierMovesByATenthOfAMillisecond)
{
    OneWayDelay delay{100};
    delay.add(10ms);
    delay.add(900ms);
    EXPECT_EQ(delay.median(), 10ms + 100us);
    for (int i = 0; i < 3; ++i) delay.add(10ms);
    EXPECT_EQ(delay.median(), 10ms);
}

} // namespace
} // namespace hapnet::peer::dead_reckoning_test
