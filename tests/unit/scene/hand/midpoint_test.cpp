// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/midpoint.hpp"

#include "tests/unit/scene/hand/rig.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

using testing::distance;

TEST(MidpointRule, NeverCostsMoreThanItsBudget)
{
    using Budget = MidpointBudget;
    for (std::size_t rows = 1; rows <= Budget::rows_max; ++rows) {
        EXPECT_LE(rows * Budget::substeps_max(rows) * Budget::newton_steps_max,
                  Budget::rows_solved_max)
            << rows;
        EXPECT_GE(Budget::substeps_max(rows), 8U) << rows;
    }
}

/// A cube that hangs in a grip, displaced by 1 mm.
struct Held {
    explicit Held(double stiffness, double force_max)
    {
        dynamics.half = glm::dvec3{0.02};
        dynamics.inverse_mass = glm::dvec3{10.0};
        dynamics.inverse_inertia = glm::dmat3{1.0 / (0.1 / 3.0 * 2.0 * 0.02 * 0.02)};
        dynamics.rotates_uniformly = true;
        spring.holds = true;
        spring.stiffness = stiffness;
        spring.force_max = force_max;
        spring.arm = {0.02, 0.0, 0.0};
        spring.stretch = {0.0, 1e-3, 0.0};
    }
    void advance(double time)
    {
        MidpointRule{body, dynamics, {&spring, 1}, {&work, 1}}.advance(time);
    }

    MovingBody body{};
    BodyDynamics dynamics{};
    HandSpring spring{};
    SpringImpulse work{};
};

TEST(MidpointRule, GivesTheImpulsesThatItSaysAtTheirLever)
{
    for (const double stiffness : {1e2, 1e5, 1e9}) {
        Held held{stiffness, 1e9};
        held.advance(1e-3);
        EXPECT_LE(distance(held.body.velocity, 10.0 * held.work.impulse), 1e-14 * stiffness / 1e5);
        EXPECT_GT(held.body.angular_momentum.z, 0.0);
    }
}

TEST(MidpointRule, AGripPullsWithItsGreatestForceTowardsTheHand)
{
    Held held{1e7, 2.0};
    held.dynamics.inverse_inertia = glm::dmat3{0.0};
    held.spring.stretch = {0.03, 0.04, 0.0};
    held.advance(1e-3);
    EXPECT_LE(distance(held.work.impulse, {1.2e-3, 1.6e-3, 0.0}), 1e-15);
}

TEST(MidpointRule, AGripWhoseForceTurnsAboutItsLimitConverges)
{
    // At its full force it still turns towards the hand.
    const auto after = [](int parts) {
        Held held{1e6, 30.0};
        held.body.velocity = {0.0, 0.0, 3.0};
        held.dynamics.inverse_inertia = glm::dmat3{0.0};
        for (int i = 0; i < parts; ++i) {
            held.advance(1e-3 / parts);
            held.spring.stretch = glm::dvec3{0.0, 1e-3, 0.0} - held.body.position;
        }
        return held.body.velocity;
    };
    const glm::dvec3 truth = after(4000);
    EXPECT_LE(distance(after(1), truth), 1e-4);
    EXPECT_LE(distance(after(100), truth), 5e-6);
}

} // namespace
} // namespace hapnet::scene
