// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/passivity.hpp"

#include "tests/unit/scene/hand/rig.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr double tick = 1e-3;

/// A cube of 0.1 kg that arrives with 0.2 m/s, and a hand before it that does not move.
struct Outcome {
    Outcome()
    {
        dynamics.half = glm::dvec3{0.02};
        dynamics.inverse_mass = glm::dvec3{10.0};
        dynamics.rotates_uniformly = true;
        spring.normal = {1.0, 0.0, 0.0};
        spring.arm = {0.02, 0.0, 0.0};
        spring.radius = 0.005;
        spring.gap = 1e-4;
        spring.stiffness = 1e6;
        start.velocity = {0.2, 0.0, 0.0};
    }
    /// Keeps a tick with this impulse passive, and returns the energies.
    HandEnergy after(double impulse, SpringsAtEnd at_end = SpringsAtEnd::ignored)
    {
        work.impulse = {impulse, 0.0, 0.0};
        end = start;
        end.velocity += 10.0 * work.impulse + tick * dynamics.acceleration;
        end.position += (0.5 * tick) * (start.velocity + end.velocity);
        return keep_passive({start, end, dynamics, tick}, {&spring, 1}, {&work, 1}, at_end);
    }

    BodyDynamics dynamics{};
    HandSpring spring{};
    SpringImpulse work{};
    MovingBody start{};
    MovingBody end{};
};

TEST(Passivity, WhatLosesEnergyStaysAsItIs)
{
    Outcome outcome;
    for (const double impulse : {-0.005, -0.01, -0.02, -0.03, -0.04}) {
        EXPECT_FALSE(outcome.after(impulse).is_braked) << impulse;
        EXPECT_EQ(outcome.work.impulse.x, impulse);
        EXPECT_EQ(outcome.end.velocity.x, 0.2 + 10.0 * impulse);
    }
}

TEST(Passivity, ABounceOffAHandAtRestIsNoFasterThanTheHit)
{
    Outcome outcome;
    const HandEnergy energy = outcome.after(-0.06); // it would leave with 0.4 m/s
    EXPECT_TRUE(energy.is_braked);
    EXPECT_NEAR(outcome.end.velocity.x, -0.2, 1e-9);
    EXPECT_NEAR(outcome.work.impulse.x, -0.04, 1e-9);
    EXPECT_NEAR(outcome.end.position.x, 0.0, 1e-12);
}

TEST(Passivity, AHandGivesWhatItsSpringStoredAndWhatItsMotionDid)
{
    Outcome outcome;
    outcome.start.velocity = {};
    outcome.spring.gap = -1e-3; // 0.5 J: 3.16 m/s
    EXPECT_FALSE(outcome.after(-0.316).is_braked);
    EXPECT_TRUE(outcome.after(-0.317).is_braked);
    EXPECT_NEAR(outcome.end.velocity.x, -std::sqrt(10.0), 1e-8);

    // The hand comes with 1 m/s and throws with 1 + sqrt(1 + 10): in its own frame as above.
    outcome.spring.velocity = {-1.0, 0.0, 0.0};
    const HandEnergy energy = outcome.after(-0.5);
    EXPECT_TRUE(energy.is_braked);
    EXPECT_NEAR(outcome.end.velocity.x, -1.0 - std::sqrt(11.0), 1e-8);
    EXPECT_NEAR(energy.stored, 0.5, 1e-15);
    EXPECT_NEAR(energy.driven, -outcome.work.impulse.x, 1e-15);
}

TEST(Passivity, TheWorkOfOtherForcesIsNotTheHands)
{
    Outcome outcome;
    outcome.dynamics.acceleration = {-500.0, 0.0, 0.0};
    EXPECT_FALSE(outcome.after(0.0).is_braked);
    // From 0.2 m/s to -0.3 without the hand, which may then only brake it.
    EXPECT_TRUE(outcome.after(-0.001).is_braked);
    EXPECT_NEAR(outcome.end.velocity.x, -0.3, 1e-6);
    EXPECT_FALSE(outcome.after(0.001).is_braked);
}

TEST(Passivity, BeyondItsGreatestForceASpringStoresEvenlyMore)
{
    HandSpring spring;
    spring.stiffness = 1000.0;
    spring.force_max = 2.0;
    EXPECT_EQ(spring_energy(spring, -1e-3), 0.0);
    EXPECT_DOUBLE_EQ(spring_energy(spring, 1e-3), 0.5e-3);
    EXPECT_DOUBLE_EQ(spring_energy(spring, 2e-3), 2e-3);
    EXPECT_DOUBLE_EQ(spring_energy(spring, 5e-3), 8e-3);
}

TEST(Passivity, ASpringThatEndsPressedHasKeptPartOfTheEnergy)
{
    // 2 mJ of motion and 0.8 mJ in the spring; it leaves with 2.65 mJ and 0.31 mJ.
    Outcome outcome;
    outcome.spring.gap = -4e-5;
    EXPECT_FALSE(outcome.after(-0.043).is_braked);
    EXPECT_TRUE(outcome.after(-0.043, SpringsAtEnd::counted).is_braked);
    EXPECT_GT(outcome.end.velocity.x, -0.23);
    EXPECT_LT(outcome.end.velocity.x, -0.2);
    EXPECT_FALSE(outcome.after(-0.04, SpringsAtEnd::counted).is_braked);
}

TEST(Passivity, NoSpringGivesMoreThanItsGreatestForceCan)
{
    Outcome outcome;
    outcome.spring.force_max = 10.0;
    EXPECT_FALSE(outcome.after(-0.01).is_braked);
    EXPECT_TRUE(outcome.after(-0.011).is_braked);
    EXPECT_NEAR(outcome.work.impulse.x, -0.01, 1e-16);
    EXPECT_NEAR(outcome.end.velocity.x, 0.1, 1e-15);
}

TEST(Passivity, ABodyThatCannotTurnKeepsItsOrientationToTheLastBit)
{
    Outcome outcome;
    const double half = std::sqrt(0.5);
    outcome.start.orientation = {half, 0.0, half, 0.0};
    EXPECT_TRUE(outcome.after(-0.06).is_braked);
    EXPECT_EQ(outcome.end.orientation, outcome.start.orientation);
}

TEST(Passivity, TurningCountsAndIsScaledByTheSameShare)
{
    Outcome outcome;
    const double inertia = 0.1 / 3.0 * 2.0 * 0.02 * 0.02;
    outcome.dynamics.inverse_inertia = glm::dmat3{1.0 / inertia};
    outcome.spring.arm = {0.02, 0.01, 0.0};
    outcome.work.impulse = {-0.05, 0.0, 0.0};
    outcome.end = outcome.start;
    outcome.end.velocity += 10.0 * outcome.work.impulse;
    outcome.end.angular_momentum = glm::cross(outcome.spring.arm, outcome.work.impulse);
    outcome.end.orientation =
        rotated(outcome.start.orientation, (0.5 * tick / inertia) * outcome.end.angular_momentum);
    const HandEnergy energy =
        keep_passive({outcome.start, outcome.end, outcome.dynamics, tick}, {&outcome.spring, 1},
                     {&outcome.work, 1}, SpringsAtEnd::ignored);
    ASSERT_TRUE(energy.is_braked);
    const double share = outcome.work.impulse.x / -0.05;
    EXPECT_NEAR(outcome.end.angular_momentum.z, share * 0.0005, 1e-18);
    const double after =
        0.05 * outcome.end.velocity.x * outcome.end.velocity.x +
        0.5 * outcome.end.angular_momentum.z * outcome.end.angular_momentum.z / inertia;
    EXPECT_NEAR(after, 0.05 * 0.2 * 0.2, 1e-8 * 0.05 * 0.2 * 0.2);
    EXPECT_NEAR(glm::length(outcome.end.orientation), 1.0, 1e-15);
}

} // namespace
} // namespace hapnet::scene
