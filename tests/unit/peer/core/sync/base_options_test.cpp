// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Each reading of the paper's pseudo-code that is not the default one. The defaults are tested in
// tests/unit/peer, and to the last bit in tests/sim/peer.
#include "peer/core/sync/base_algorithm.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

constexpr double nm = 1e-6; // in millimetres: rounding

Copy<BaseAlgorithm> copy_with(const BaseOptions& options)
{
    return Copy<BaseAlgorithm>{BaseAlgorithm{options}, options.stale};
}

TEST(BaseOptions, FollowingRelativelyMovesABodyAsTheOtherMovesAndLeavesThemApart)
{
    Copy copy = copy_with({.follow = Follow::relative, .bleed = std::nullopt});
    copy.hear({.sequence = 1, .body_mm = 5.0}, 0.0);
    std::ignore = copy.tick(0.0);
    EXPECT_NEAR(copy.x_mm(), 0.0, nm); // no motion since the first message
    copy.hear({.sequence = 2, .body_mm = 5.5, .speed_m_per_s = 0.5}, 1.0);
    std::ignore = copy.tick(1.0);
    EXPECT_NEAR(copy.x_mm(), 0.5, nm);
    EXPECT_EQ(copy.speed(), 0.5);
    std::ignore = copy.tick(2.0); // no motion since the last tick, at any speed
    EXPECT_NEAR(copy.x_mm(), 0.5, nm);
    copy.hear({.sequence = 9, .body_mm = 9.0}, 3.0); // contains the motion of lost messages
    std::ignore = copy.tick(3.0);
    EXPECT_NEAR(copy.x_mm(), 4.0, nm);
}

TEST(BaseOptions, TheSignThatThePaperPrintsMovesABodyBackward)
{
    Copy copy = copy_with({.displacement = DisplacementSign::previous_minus_current,
                           .follow = Follow::relative,
                           .bleed = std::nullopt});
    copy.hear({.sequence = 1, .body_mm = 5.0}, 0.0);
    std::ignore = copy.tick(0.0);
    copy.hear({.sequence = 2, .body_mm = 5.5, .speed_m_per_s = 0.5}, 1.0);
    std::ignore = copy.tick(1.0);
    EXPECT_NEAR(copy.x_mm(), -0.5, nm);
    EXPECT_EQ(copy.speed(), -0.5);
}

TEST(BaseOptions, ARelativeFollowBleedsItsDifferenceAway)
{
    Copy copy = copy_with({.follow = Follow::relative, .bleed = 10ms});
    copy.hear({.sequence = 1, .body_mm = 5.0}, 0.0);
    double expected = 0.0;
    for (int ms = 0; ms < 20; ++ms) {
        std::ignore = copy.tick(ms);
        expected += 0.1 * (5.0 - expected); // a tenth in every tick
        ASSERT_NEAR(copy.x_mm(), expected, nm) << ms;
    }
}

TEST(BaseOptions, IncrementsAreLostWithTheirMessages)
{
    Copy copy = copy_with({.displacement_from = DisplacementFrom::increments,
                           .follow = Follow::relative,
                           .bleed = std::nullopt});
    copy.hear({.sequence = 1, .body_mm = 5.0, .speed_m_per_s = 0.2}, 0.0);
    copy.hear({.sequence = 2, .body_mm = 5.2, .speed_m_per_s = 0.3}, 0.0); // two in one tick
    std::ignore = copy.tick(0.0);
    EXPECT_NEAR(copy.x_mm(), 0.2 + 0.3, nm);
    copy.hear({.sequence = 9, .body_mm = 9.0, .speed_m_per_s = 0.4}, 1.0); // 3 to 8 are lost
    std::ignore = copy.tick(1.0);
    EXPECT_NEAR(copy.x_mm(), 0.5 + 0.4, nm);
    copy.hear({.sequence = 10, .speed_m_per_s = 0.4, .touching = false}, 2.0);
    std::ignore = copy.tick(2.0);      // no message, no increment
    EXPECT_LT(copy.x_mm(), 0.9 + 0.4); // it coasts
}

TEST(BaseOptions, FollowingAlwaysTakesTheOtherBodysPlaceAlsoWhenNobodyTouches)
{
    Copy copy = copy_with({.follow_while = FollowWhile::always});
    copy.hear({.body_mm = 5.0, .touching = false}, 0.0);
    std::ignore = copy.tick(0.0);
    EXPECT_EQ(copy.x_mm(), 5.0);
    std::ignore = copy.tick(1.0, away, 0.0); // but no stale message
    copy.hear({.sequence = 2, .body_mm = 7.0, .touching = false}, 1.0);
    std::ignore = copy.tick(2.0, away, 0.0);
    EXPECT_EQ(copy.x_mm(), 5.0);
}

TEST(BaseOptions, ARemoteForceOnTheHandTooIsFeltTwice)
{
    Copy copy = copy_with({.remote_force_on = RemoteForceOn::body_and_hand});
    scene::World expected = paper_world();
    copy.hear({.force_n = -0.5}, 0.0);
    const Outcome outcome = copy.tick(0.0, pushing_hip(0.004));
    tick(expected, pushing_hip(0.004), -0.5);
    EXPECT_EQ(copy.world.hash(), expected.hash());
    EXPECT_EQ(outcome.on_hand.x(), expected.touch(own_hand).on_hand.x() - 0.5);
    EXPECT_EQ(copy.tick(1.0, away).on_hand, base::Force{}); // a hand off the body feels nothing
}

TEST(BaseOptions, TheStrongerAloneMovesWhatBothPush)
{
    Copy copy = copy_with({.both_push = BothPush::stronger});
    scene::World alone = paper_world();
    std::ignore = copy.tick(0.0, pushing_hip(0.004)); // 2 N
    tick(alone, pushing_hip(0.004));
    copy.hear({.body_mm = 3.0, .force_n = -0.5}, 1.0);
    const Outcome stronger = copy.tick(1.0, pushing_hip(0.004));
    tick(alone, pushing_hip(0.004));
    EXPECT_EQ(copy.world.hash(), alone.hash());
    EXPECT_EQ(stronger.remote_force, base::Force{}); // it does not count
    EXPECT_TRUE(stronger.remote_touching);
    copy.hear({.sequence = 2, .body_mm = 3.0, .force_n = -3.0}, 2.0);
    const Outcome weaker = copy.tick(2.0, pushing_hip(0.004));
    EXPECT_EQ(copy.x_mm(), 3.0); // the place in the stronger hand's copy
    EXPECT_TRUE(weaker.touched.touching);
    EXPECT_GT(-weaker.on_hand.x(), 0.1);
}

TEST(BaseOptions, TheStrongerKeepsTheBodyForTheHysteresisAndForARoundTripAtLeast)
{
    const auto changes_over_at = [](base::Duration hysteresis, base::Duration half_round_trip) {
        Copy copy = copy_with({.both_push = BothPush::stronger, .hysteresis = hysteresis});
        copy.clock = ClockEstimate{{}, half_round_trip};
        std::ignore = copy.tick(0.0, pushing_hip(0.004));
        copy.hear({.body_mm = 3.0, .force_n = -0.5}, 1.0);
        std::ignore = copy.tick(1.0, pushing_hip(0.004)); // this side leads from 1 ms on
        copy.hear({.sequence = 2, .body_mm = 3.0, .force_n = -3.0}, 2.0);
        int ms = 2;
        for (; ms < 200 && copy.x_mm() != 3.0; ++ms)
            std::ignore = copy.tick(ms, pushing_hip(0.004));
        return ms - 1;
    };
    EXPECT_EQ(changes_over_at(0ms, 0ms), 2);
    EXPECT_EQ(changes_over_at(30ms, 10ms), 31);
    EXPECT_EQ(changes_over_at(30ms, 20ms), 41);
}

TEST(BaseOptions, EqualForcesLeaveTheBodyToTheLowerId)
{
    for (const bool yields : {true, false}) {
        Copy copy = copy_with({.both_push = BothPush::stronger});
        copy.yields = yields;
        copy.hear({.body_mm = 3.0, .force_n = 0.0}, 0.0); // not stronger than no push
        std::ignore = copy.tick(0.0, pushing_hip(0.004));
        EXPECT_EQ(copy.x_mm() == 3.0, yields);
    }
}

TEST(BaseOptions, StaleMessagesThatAreTakenBringTheirPastBack)
{
    Copy copy = copy_with({.stale = Stale::take});
    copy.hear({.sequence = 2, .body_mm = 2.0}, 0.0);
    copy.hear({.sequence = 1, .body_mm = 1.0}, 0.5);
    std::ignore = copy.tick(1.0);
    EXPECT_EQ(copy.x_mm(), 1.0);
    Copy dropping = copy_with({});
    dropping.hear({.sequence = 2, .body_mm = 2.0}, 0.0);
    dropping.hear({.sequence = 1, .body_mm = 1.0}, 0.5);
    std::ignore = dropping.tick(1.0);
    EXPECT_EQ(dropping.x_mm(), 2.0);
}

TEST(BaseOptions, LettingGoTreatsASilentHandAsOffTheBody)
{
    Copy copy = copy_with({.let_go_after = 5ms});
    copy.hear({.body_mm = 2.0, .force_n = -0.5}, 0.0);
    EXPECT_TRUE(copy.tick(5.0).remote_touching);
    EXPECT_EQ(copy.x_mm(), 2.0);
    EXPECT_FALSE(copy.tick(5.5).remote_touching);
    scene::World expected = paper_world();
    std::ignore = copy.tick(6.0, pushing_hip(0.006));
    copy.hear({.sequence = 2, .body_mm = 3.0}, 7.0);
    std::ignore = copy.tick(7.0);
    EXPECT_EQ(copy.x_mm(), 3.0);
}

TEST(BaseOptions, AlongXAloneTheOtherSideActsOnNothingElse)
{
    const BaseOptions options{.axes = Axes::x};
    Remote remote{{}};
    wire::State state;
    state.sequence = 1;
    state.touching = true;
    state.contact_force = {{-0.3, 0.4, 1.2}};
    wire::BodyState& body = state.bodies.add(wire::BodyState{});
    body.position = {{0.001, 0.002, 0.003}};
    body.velocity = {{0.1, 0.2, 0.3}};
    remote.update(state, start);
    look_when_fresh_by(1.0, remote);
    const Situation situation{.now = start, .others = {&remote, 1}, .remote = remote};
    EXPECT_EQ(combined_remote(situation, options).force, (base::Force{{-0.3, 0.0, 0.0}}));
    scene::World world = paper_world();
    BaseAlgorithm algorithm{options};
    std::ignore = algorithm.tick(world, situation);
    EXPECT_EQ(world.body(0).position, (base::Position{{0.001, 0.0, 0.0}}));
    EXPECT_EQ(world.body(0).velocity, (base::Velocity{{0.1, 0.0, 0.0}}));
}

TEST(BaseOptions, SettlingTakesTheTimesThatItIsGivenOrNeverHappens)
{
    const auto x_mm_after = [](const BaseOptions& options, int ticks) {
        Copy copy = copy_with(options);
        copy.hear({.body_mm = 2.0, .touching = false}, 0.0);
        for (int ms = 0; ms < ticks; ++ms) std::ignore = copy.tick(ms);
        return copy.x_mm();
    };
    const BaseOptions soon{.settle_after = 3ms, .settle_within = 4ms};
    EXPECT_NEAR(x_mm_after(soon, 3), 0.0, nm);
    EXPECT_NEAR(x_mm_after(soon, 4), 0.0, nm); // the blend begins here
    EXPECT_NEAR(x_mm_after(soon, 5), 0.5, nm);
    EXPECT_NEAR(x_mm_after(soon, 8), 2.0, nm);
    EXPECT_EQ(x_mm_after({.settle_after = 3ms, .settle_within = 0ms}, 4), 2.0);
    EXPECT_EQ(x_mm_after({.settle_after = std::nullopt}, 1000), 0.0);
}

TEST(BaseOptions, AForgottenRunLeavesNoDisplacementBehind)
{
    Copy copy = copy_with({.follow = Follow::relative, .bleed = std::nullopt});
    copy.hear({.body_mm = 5.0}, 0.0);
    std::ignore = copy.tick(0.0);
    copy.remote.forget_state();
    copy.algorithm.forget();
    copy.hear({.body_mm = 50.0}, 1.0); // elsewhere, as a new run may send it
    std::ignore = copy.tick(1.0);
    EXPECT_NEAR(copy.x_mm(), 0.0, nm);
}

} // namespace
} // namespace hapnet::peer
