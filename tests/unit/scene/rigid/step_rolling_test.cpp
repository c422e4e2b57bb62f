// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/rigid/scenes.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

using std::chrono::microseconds;

BodyDescription ball_at(const glm::dvec3& place, double radius = half)
{
    BodyDescription ball = cube_at(place);
    ball.name = "ball";
    ball.shape = Shape::sphere;
    ball.half = glm::dvec3{radius};
    return ball;
}

/// A capsule that lies along z.
BodyDescription capsule_at(const glm::dvec3& place, double straight = 0.03)
{
    BodyDescription capsule = cube_at(place);
    capsule.name = "capsule";
    capsule.shape = Shape::capsule;
    capsule.half = {half, half, half + straight};
    return capsule;
}

/// Returns the slip of the lowest point of a ball on the platform.
glm::dvec3 slip(const BodyState& state)
{
    return state.velocity.value + glm::cross(state.angular_velocity, glm::dvec3{0.0, -half, 0.0});
}

TEST(Rolling, ABallThatSlidesRollsAtFiveSeventhsOfItsSpeedFromTheMomentOfTheFormula)
{
    constexpr double speed = 1.0;
    for (const int tick_us : {4000, 1000, 250}) {
        Description scene = platform();
        scene.bodies.push_back(ball_at({0.0, half, 0.0}));
        scene.bodies[0].velocity = {{speed, 0.0, 0.0}};
        World world = world_of(scene, microseconds{tick_us});
        const double until = 2.0 / 7.0 * speed / (friction * gravity);
        const double tick = 1e-6 * tick_us;
        int slipping = 0;
        for (int i = 0; i < 200'000 / tick_us; ++i) {
            world.tick();
            if (length(slip(world.body(0))) > 1e-9) ++slipping;
        }
        const BodyState state = world.body(0);
        EXPECT_LT(std::abs(state.velocity.x() - 5.0 / 7.0 * speed), 1e-9);
        EXPECT_LT(length(slip(state)), 1e-9);
        EXPECT_NEAR(slipping * tick, until, tick);
        const double went = speed * until - 0.5 * friction * gravity * until * until +
                            5.0 / 7.0 * speed * (0.2 - until);
        // The error of the tick in which it begins to roll is of first order.
        EXPECT_NEAR(state.position.x(), went, friction * gravity * tick * tick);
        EXPECT_NEAR(state.position.y(), half, 1e-9);
    }
}

TEST(Rolling, DownASlopeIsAsSlowAsTheMomentOfInertiaSays)
{
    for (const BodyDescription& round : {ball_at({0.0, half, 0.0}), capsule_at({0.0, half, 0.0})}) {
        // For a ball 2/5 m r^2: 5/7 of the acceleration without friction.
        const double turns = inertia_of(round).z / (round.mass_kg * half * half);
        EXPECT_NEAR(turns, round.shape == Shape::sphere ? 0.4 : 0.469, 1e-3);
        for (const double slope : {0.1, 0.5, 0.9}) { // friction holds beyond
            for (const int tick_us : {4000, 1000, 250}) {
                const double angle = std::atan(slope);
                Description scene = platform();
                scene.planes[0].normal = {std::sin(angle), std::cos(angle), 0.0};
                scene.bodies.push_back(round);
                scene.bodies[0].position.value = half * scene.planes[0].normal;
                World world = world_of(scene, microseconds{tick_us});
                run(world, static_cast<std::uint64_t>(500'000 / tick_us));
                const BodyState state = world.body(0);
                const double rate = gravity * std::sin(angle) / (1.0 + turns);
                const glm::dvec3 down{std::cos(angle), -std::sin(angle), 0.0};
                const glm::dvec3 want = scene.bodies[0].position.value + 0.5 * rate * 0.25 * down;
                // It falls onto the slope and finds the friction in the first tick, so it begins
                // this much later.
                const double late = 1e-6 * tick_us;
                EXPECT_LT(length(state.position.value - want), late * rate * 0.5) << round.name;
                EXPECT_LT(length(state.velocity.value - 0.5 * rate * down), late * rate)
                    << round.name;
            }
        }
    }
}

TEST(Rolling, ABallOnASteepSlopeSlipsWithWhatFrictionLeavesIt)
{
    const double angle = std::atan(2.0);
    Description scene = platform();
    scene.planes[0].normal = {std::sin(angle), std::cos(angle), 0.0};
    scene.bodies.push_back(ball_at(half * scene.planes[0].normal));
    World world = world_of(scene);
    run(world, 300);
    const double rate = gravity * (std::sin(angle) - friction * std::cos(angle));
    EXPECT_NEAR(length(world.body(0).velocity.value), 0.3 * rate, 1e-9);
    const double spin = 2.5 * friction * gravity * std::cos(angle) / half;
    EXPECT_NEAR(length(world.body(0).angular_velocity), 0.3 * spin, 1e-7);
}

TEST(Rolling, WhatRollsOnALevelPlaneGoesOnForEverAndStaysOnItsHeight)
{
    for (const BodyDescription& round : {ball_at({0.0, half, 0.0}), capsule_at({0.0, half, 0.0})}) {
        Description scene = platform();
        scene.bodies.push_back(round);
        scene.bodies[0].velocity = {{0.5, 0.0, 0.0}};
        scene.bodies[0].angular_velocity = {0.0, 0.0, -0.5 / half};
        World world = world_of(scene);
        run(world, 3000);
        const BodyState state = world.body(0);
        EXPECT_LT(length(state.velocity.value - glm::dvec3{0.5, 0.0, 0.0}), 1e-9) << round.name;
        EXPECT_LT(length(state.position.value - glm::dvec3{1.5, half, 0.0}), 1e-8) << round.name;
    }
}

TEST(Rolling, ABallThatIsThrownWithBackspinComesBack)
{
    Description scene = platform();
    scene.bodies.push_back(ball_at({0.0, half, 0.0}));
    scene.bodies[0].velocity = {{0.4, 0.0, 0.0}};
    scene.bodies[0].angular_velocity = {0.0, 0.0, 100.0};
    World world = world_of(scene);
    run(world, 1000);
    // About a point of the platform nothing gives it angular momentum: 7/5 v = v0 - 2/5 r w0.
    EXPECT_NEAR(world.body(0).velocity.x(), (0.4 - 0.4 * half * 100.0) * 5.0 / 7.0, 1e-9);
}

TEST(Rolling, ABallAtRestStays)
{
    Description scene = platform();
    scene.bodies.push_back(ball_at({0.0, half, 0.0}));
    World world = world_of(scene);
    run(world, 1000);
    EXPECT_LT(drift(world, scene), 1e-12);
}

TEST(Rolling, ACapsuleThatFallsOnOneEndComesToRestOnBothAndGainsNothing)
{
    Description scene = platform();
    scene.bodies.push_back(capsule_at({0.0, half + 0.03 * std::sin(0.1), 0.0}));
    scene.bodies[0].orientation = {std::cos(0.05), std::sin(0.05), 0.0, 0.0};
    World world = world_of(scene);
    double most = energy(world);
    const double first = most;
    for (int i = 0; i < 2000; ++i) {
        world.tick();
        most = std::max(most, energy(world));
    }
    EXPECT_LE(most, first + 1e-9);
    EXPECT_NEAR(world.body(0).position.y(), half, 1e-6);
    EXPECT_LT(length(world.body(0).angular_velocity), 1e-6);
}

} // namespace

} // namespace hapnet::scene
