// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/account.hpp"

#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::account_test {
namespace {

constexpr double mass = 0.1;
constexpr double tick = 1e-3;

/// A tick with the push of one hand, as the account finds it.
class Account : public testing::Test {
protected:
    Account()
    {
        box_.velocity = {};
        for (AxisMotion& axis : box_.axes) axis = {};
        box_.position = {};
        box_.is_exact = false;
    }

    /// Records a push of the hand along x with this force, from this depth.
    void push(double force, double depth)
    {
        HandTouch& touch = state_.touches[0];
        touch.touching = true;
        touch.depth_m = depth;
        touch.on_body.value.x = force;
        touch.on_hand.value.x = -force;
        box_.velocity[0] = start_.velocity[0] + force * tick / mass;
    }
    void settle() { scene::settle(config_, state_, start_, box_); }

    [[nodiscard]] double energy() const { return 0.5 * mass * dot(box_.velocity, box_.velocity); }

    Description scene_ = lone_cube();
    WorldConfig config_{.hands = scene_.hands, .tick = tick};
    WorldState state_{.bodies = Bodies{scene_}};
    AxisOscillators oscillators_{config_.hands, state_.bodies.properties[0], tick};
    Obstacles obstacles_{config_, state_.bodies, state_.bodies.properties[0]};
    TickRoom room_;
    BoxMotion box_{config_.hands, oscillators_, obstacles_, room_};
    TickStart start_;
};

TEST_F(Account, LeavesAloneWhatTheSpringHadStored)
{
    push(3.0, 0.02); // 0.1 J stored, 0.045 mJ given
    settle();
    EXPECT_EQ(box_.velocity[0], 0.03);
    EXPECT_EQ(state_.touches[0].on_body.x(), 3.0);
    EXPECT_EQ(state_.interventions.hands_braked, 0U);
}

TEST_F(Account, TakesNoMoreThanWasStoredAndReportsNoMoreThanWasGiven)
{
    push(1000.0, 0.001); // 5 J instead of 0.25 mJ
    settle();
    EXPECT_NEAR(energy(), 2.5e-4, 1e-6);
    EXPECT_NEAR(mass * box_.velocity[0], tick * state_.touches[0].on_body.x(), 1e-15);
    EXPECT_EQ(state_.touches[0].on_body.x(), -state_.touches[0].on_hand.x());
    EXPECT_EQ(state_.interventions.hands_braked, 1U);
}

TEST_F(Account, CountsTheWorkOfTheHandsMotion)
{
    push(1000.0, 0.001);
    state_.hands[0].velocity = {{5.0, 0.0, 0.0}}; // 5 J
    settle();
    EXPECT_EQ(box_.velocity[0], 10.0);
    EXPECT_EQ(state_.interventions.hands_braked, 0U);
}

TEST_F(Account, LetsNoHandGiveMoreThanItsGreatestForce)
{
    config_.hands.force_max_n = 2.0;
    push(3.0, 0.02);
    settle();
    EXPECT_NEAR(state_.touches[0].on_body.x(), 2.0, 1e-12);
    EXPECT_NEAR(box_.velocity[0], 0.02, 1e-12);
    EXPECT_EQ(state_.interventions.hands_braked, 1U);
}

TEST_F(Account, BringsABoxWithoutHandsBackToItsFall)
{
    start_.steady = {0.0, -10.0, 0.0};
    box_.velocity = {0.0, 0.5, 0.0}; // an obstacle has thrown it up
    settle();
    EXPECT_LE(energy(), 2e-5); // of 12.5 mJ; the fall itself is 5e-6 J
    EXPECT_EQ(state_.interventions.islands_limited, 1U);
    EXPECT_EQ(state_.interventions.hands_braked, 0U);
}

} // namespace
} // namespace hapnet::scene::account_test
