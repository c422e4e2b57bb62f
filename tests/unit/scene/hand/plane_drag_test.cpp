// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/plane_drag.hpp"

#include "tests/unit/scene/hand/rig.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

using testing::distance;

constexpr double ms = 1e-3;

BodyDynamics dragged(double drag, const glm::dvec3& inverse_mass = glm::dvec3{10.0})
{
    BodyDynamics dynamics;
    dynamics.inverse_mass = inverse_mass;
    dynamics.drag = drag;
    dynamics.drag_normal = {0.0, 1.0, 0.0};
    return dynamics;
}

TEST(PlaneDrag, IsTheFormulaHoweverStrongItIs)
{
    const glm::dvec3 velocity{0.3, -0.2, 0.1};
    const glm::dvec3 acceleration{5.0, -9.81, -7.0};
    for (double drag = 1e-6; drag < 1e7; drag *= 3.0) {
        const PlaneDrag motion{dragged(drag), ms};
        const glm::dvec3 goal = acceleration / drag; // where the velocity goes along the plane
        const double kept = std::exp(-drag * ms);
        const double mean = -std::expm1(-drag * ms) / (drag * ms);
        const glm::dvec3 after = motion.velocity_after(velocity, acceleration);
        const glm::dvec3 over = motion.mean_velocity(velocity, acceleration);
        for (const int axis : {0, 2}) {
            const double size = 1.0 + std::abs(goal[axis]);
            EXPECT_NEAR(after[axis], goal[axis] + kept * (velocity[axis] - goal[axis]),
                        1e-15 * size)
                << drag;
            EXPECT_NEAR(over[axis], goal[axis] + mean * (velocity[axis] - goal[axis]), 1e-15 * size)
                << drag;
        }
        EXPECT_DOUBLE_EQ(after.y, velocity.y + ms * acceleration.y);
        EXPECT_DOUBLE_EQ(over.y, velocity.y + 0.5 * ms * acceleration.y);
    }
}

TEST(PlaneDrag, WithoutDragItIsTheParabola)
{
    const PlaneDrag motion{dragged(0.0), ms};
    const glm::dvec3 velocity{0.3, -0.2, 0.1};
    const glm::dvec3 acceleration{5.0, -9.81, -7.0};
    EXPECT_EQ(motion.velocity_after(velocity, acceleration), velocity + ms * acceleration);
    EXPECT_EQ(motion.mean_velocity(velocity, acceleration), velocity + ms * (0.5 * acceleration));
}

TEST(PlaneDrag, ItsRootIsHowAForceMovesTheCentre)
{
    for (const double drag : {0.0, 3.0, 700.0, 1e6}) {
        for (const glm::dvec3& light : {glm::dvec3{10.0}, glm::dvec3{10.0, 0.0, 10.0}}) {
            BodyDynamics dynamics = dragged(drag, light);
            dynamics.drag_normal = {0.6, 0.8, 0.0};
            const PlaneDrag motion{dynamics, ms};
            const glm::dvec3 force{1.0, 2.0, 3.0};
            const glm::dvec3 moved = motion.mean_velocity(glm::dvec3{0.0}, light * force) / ms;
            const glm::dvec3 root = motion.root_of_response(force);
            EXPECT_NEAR(glm::dot(root, root), glm::dot(force, moved),
                        1e-13 * glm::dot(force, moved));
        }
    }
}

TEST(PlaneDrag, AlongAPlaneThatCutsALockedAxisItActsInPart)
{
    // Locked in y over a slope: x is slanted, z lies in the plane.
    BodyDynamics dynamics = dragged(200.0, {10.0, 0.0, 10.0});
    dynamics.drag_normal = {0.6, 0.8, 0.0};
    const PlaneDrag motion{dynamics, ms};
    const glm::dvec3 after = motion.velocity_after({1.0, 0.0, 1.0}, glm::dvec3{0.0});
    EXPECT_NEAR(after.x, std::exp(-0.64 * 0.2), 1e-15);
    EXPECT_EQ(after.y, 0.0);
    EXPECT_NEAR(after.z, std::exp(-0.2), 1e-15);
}

TEST(PlaneDrag, ASteadyPushAgainstItHoldsItsForceAndLagsByNothing)
{
    // 0.1 kg at 0.1 m/s. Beyond a third of the half edge the spring would be through the body.
    for (const double drag : {1.0, 100.0, 3e3, 1e5}) {
        for (const double stiffness : {1e3, 1e5, 1e7}) {
            const double force = 0.1 * drag * 0.1;
            if (force / stiffness > 0.006) continue;
            testing::Rig rig;
            rig.body.velocity = {0.1, 0.0, 0.0};
            rig.hands.push_back({.position = {force / stiffness - 0.025, 0.0, 0.0},
                                 .velocity = {0.1, 0.0, 0.0},
                                 .stiffness = stiffness,
                                 .damping = 2e-3 * stiffness});
            for (int i = 0; i < 1000; ++i) {
                BodyDynamics dynamics = dragged(drag);
                dynamics.half = rig.half;
                const HandSpring spring = rig.touch(rig.body, rig.hands[0]);
                PressedModes modes;
                advance(rig.body, dynamics, {&spring, 1}, rig.work, ms, modes);
                rig.hands[0].position += ms * rig.hands[0].velocity;
            }
            EXPECT_NEAR(rig.body.position.x, 0.1, 1e-12) << drag << ' ' << stiffness;
            EXPECT_NEAR(rig.work[0].impulse.x, force * ms, 1e-9 * force * ms)
                << drag << ' ' << stiffness;
        }
    }
}

TEST(PlaneDrag, StiffHandsOnADraggedBodyNeverAddEnergy)
{
    for (const double drag : {0.1, 30.0, 1e3, 1e5}) {
        for (double stiffness = 1e3; stiffness < 1e9; stiffness *= 10.0) {
            testing::Rig rig;
            rig.body.velocity = {0.3, 0.0, 0.1};
            rig.hands.push_back({.position = {0.0252, 0.003, 0.0}, .stiffness = stiffness});
            rig.hands.push_back({.position = {-0.0252, 0.001, 0.0}, .stiffness = stiffness});
            const double start = rig.energy();
            double before = start;
            for (int i = 0; i < 200; ++i) {
                BodyDynamics dynamics = rig.dynamics();
                dynamics.drag = drag;
                dynamics.drag_normal = {0.0, 1.0, 0.0};
                const std::array<HandSpring, 2> springs{rig.touch(rig.body, rig.hands[0]),
                                                        rig.touch(rig.body, rig.hands[1])};
                PressedModes modes;
                advance(rig.body, dynamics, springs, rig.work, ms, modes);
                const double now = rig.energy();
                ASSERT_LE(now, before + 1e-3 * start) << drag << ' ' << stiffness << ' ' << i;
                before = now;
            }
            EXPECT_LT(before, start) << drag << ' ' << stiffness;
        }
    }
}

} // namespace
} // namespace hapnet::scene
