// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/hand/rig.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

using testing::distance;
using testing::Hand;
using testing::Reference;
using testing::Rig;

/// A cube on its way to a hand at rest, `aside` metres off its centre.
Rig bouncing(double stiffness, double aside)
{
    Rig rig;
    rig.body.velocity = {0.2, 0.0, 0.0};
    rig.hands.push_back({.position = {0.0253, aside, 0.3 * aside}, .stiffness = stiffness});
    return rig;
}

TEST(Advance, WithoutHandsABodyFallsAndTurns)
{
    Rig rig;
    rig.acceleration = {0.0, -9.81, 0.0};
    rig.body.velocity = {1.0, 0.0, 0.0};
    rig.body.angular_momentum = box_inertia(0.1, rig.half) * glm::dvec3{0.0, 3.0, 0.0};
    rig.run(1.0, 1e-3);
    EXPECT_LE(distance(rig.body.position, {1.0, -4.905, 0.0}), 1e-12);
    EXPECT_NEAR(rig.body.orientation.y, std::sin(1.5), 1e-13);
}

TEST(Advance, AStraightBounceKeepsItsEnergyHoweverStiffTheHandIs)
{
    for (double stiffness = 1e3; stiffness < 2e8; stiffness *= 3.0) {
        Rig rig = bouncing(stiffness, 0.0);
        rig.run(0.1, 1e-3);
        EXPECT_NEAR(rig.body.velocity.x, -0.2, 0.2e-12) << stiffness;
        EXPECT_EQ(rig.body.velocity.y, 0.0);
    }
}

TEST(Advance, ABounceOffTheCentreKeepsItsEnergyHoweverStiffTheHandIs)
{
    for (double stiffness = 1e3; stiffness < 2e8; stiffness *= 3.0) {
        for (const double aside : {0.003, 0.011, -0.016}) {
            Rig cube = bouncing(stiffness, aside);
            const double before = cube.energy();
            cube.run(0.1, 1e-3);
            EXPECT_NEAR(cube.energy() / before, 1.0, 1e-5) << stiffness << ' ' << aside;
            Rig box = bouncing(stiffness, aside);
            box.half = {0.02, 0.03, 0.015};
            box.run(0.1, 1e-3);
            EXPECT_NEAR(box.energy() / before, 1.0, 1e-4) << stiffness << ' ' << aside;
        }
    }
}

TEST(Advance, APushOffTheCentreIsOfSecondOrderAgainstASmallStepReference)
{
    Rig start;
    start.half = {0.02, 0.03, 0.015};
    start.body.velocity = {0.02, 0.0, 0.0};
    start.hands.push_back(
        {.position = {-0.0245, 0.006, 0.009}, .velocity = {0.15, 0.01, -0.02}, .damping = 2.0});
    const MovingBody truth = Reference{start}.run(0.032, 4000);
    double before = 0.0;
    for (const double tick : {2e-3, 1e-3, 0.5e-3, 0.25e-3}) {
        Rig rig = start;
        rig.run(0.032, tick);
        const double error =
            distance(rig.body.position, truth.position) +
            0.02 *
                distance({rig.body.orientation.x, rig.body.orientation.y, rig.body.orientation.z},
                         {truth.orientation.x, truth.orientation.y, truth.orientation.z});
        if (before > 0.0) {
            EXPECT_LE(error, before / 3.0) << tick;
        }
        if (tick == 1e-3) {
            EXPECT_LE(error, 4e-7);
        }
        before = error;
    }
}

TEST(Advance, ASteadyPushHoldsItsForceAndLagsByNothing)
{
    Rig rig;
    rig.acceleration = {-5.0, 0.0, 0.0};
    rig.body.velocity = {0.1, 0.0, 0.0};
    // 0.5 N against 500 N/m: 1 mm deep.
    rig.hands.push_back({.position = {-0.024, 0.0, 0.0},
                         .velocity = {0.1, 0.0, 0.0},
                         .stiffness = 500.0,
                         .damping = 2.0,
                         .force_max = 3.3});
    for (int i = 0; i < 1000; ++i) {
        rig.tick(1e-3);
        ASSERT_NEAR(rig.work[0].impulse.x, 0.5e-3, 0.5e-15);
    }
    EXPECT_NEAR(rig.body.position.x, 0.1, 1e-14);
    EXPECT_EQ(rig.body.velocity.y, 0.0);
}

TEST(Advance, AHandPushesNoHarderThanItsLimit)
{
    Rig rig;
    rig.hands.push_back({.position = {-0.0251, 0.0, 0.0},
                         .velocity = {0.5, 0.0, 0.0},
                         .stiffness = 5000.0,
                         .force_max = 3.3});
    double most = 0.0;
    for (int i = 0; i < 50; ++i) {
        rig.tick(1e-3);
        most = std::max(most, rig.work[0].impulse.x);
    }
    EXPECT_NEAR(most, 3.3e-3, 1e-15);
    // In the hand's frame the cube arrives with 0.5 m/s and bounces back equally fast.
    EXPECT_NEAR(rig.body.velocity.x, 1.0, 1e-9);
}

Rig squeezed(double shift)
{
    Rig rig;
    rig.hands.push_back({.position = {-0.0242, 0.004, 0.0}});
    rig.hands.push_back({.position = {0.0242, 0.004, 0.0}});
    rig.body.position.x = shift;
    return rig;
}

TEST(Advance, BetweenTwoHandsACubeSwingsAsTheFormulaSaysForTenPeriods)
{
    constexpr double start = 1e-4;
    const double frequency = std::sqrt(2.0 * 1000.0 / 0.1);
    for (const double tick : {4e-3, 1e-3, 0.25e-3}) {
        Rig rig = squeezed(start);
        rig.hands[0].position.y = rig.hands[1].position.y = 0.0;
        const auto ticks = std::lround(10.0 * 6.283185307179586 / frequency / tick);
        double squares = 0.0;
        for (long i = 1; i <= ticks; ++i) {
            rig.tick(tick);
            const double error =
                rig.body.position.x - start * std::cos(frequency * static_cast<double>(i) * tick);
            squares += error * error;
        }
        EXPECT_LE(std::sqrt(squares / static_cast<double>(ticks)) / start, 1e-9) << tick;
    }
}

TEST(Advance, ASymmetricSqueezeMovesNothingAtAll)
{
    Rig rig = squeezed(0.0);
    for (Hand& hand : rig.hands) {
        hand.damping = 2.0;
        hand.position.y = 0.0;
        hand.velocity.x = hand.position.x < 0.0 ? 0.001 : -0.001;
    }
    rig.run(1.0, 1e-3);
    EXPECT_EQ(rig.body.position, glm::dvec3{0.0});
    EXPECT_EQ(rig.body.velocity, glm::dvec3{0.0});
    EXPECT_EQ(rig.body.orientation, (glm::dquat{1.0, 0.0, 0.0, 0.0}));
    EXPECT_NEAR(rig.work[0].impulse.x, 1.8015e-3, 1e-12);
}

TEST(Advance, HandsThatLetGoAndTouchAgainKeepTheEnergyToo)
{
    Rig rig = squeezed(0.0);
    rig.body.velocity = {0.3, 0.0, 0.0};
    const double before = rig.energy();
    for (int i = 0; i < 1000; ++i) rig.tick(1e-3);
    EXPECT_NEAR(rig.energy() / before, 1.0, 1e-4);
}

TEST(Advance, ThreeHandsKeepTheEnergyByTheMidpointRule)
{
    Rig rig = squeezed(0.0);
    rig.hands.push_back({.position = {0.003, -0.0248, 0.001}});
    rig.body.velocity = {0.05, -0.1, 0.02};
    const double before = rig.energy();
    double most = 0.0;
    for (int i = 0; i < 500; ++i) {
        rig.tick(1e-3);
        most = std::max(most, std::abs(rig.energy() / before - 1.0));
    }
    EXPECT_LE(most, 2e-3);
}

TEST(Advance, ASpringThatHoldsPullsAsWellAndSwingsAsTheFormulaSays)
{
    MovingBody body;
    BodyDynamics dynamics;
    dynamics.inverse_mass = glm::dvec3{10.0};
    HandSpring spring;
    spring.holds = true;
    spring.stiffness = 1000.0;
    std::array<SpringImpulse, 1> work;
    PressedModes modes;
    const glm::dvec3 hand{0.001, -0.002, 0.0005};
    for (int i = 0; i < 500; ++i) {
        spring.stretch = hand - body.position;
        advance(body, dynamics, {&spring, 1}, work, 1e-4, modes);
    }
    EXPECT_LE(distance(body.position, (1.0 - std::cos(100.0 * 0.05)) * hand), 1e-6);
}

} // namespace
} // namespace hapnet::scene
