// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/rigid/scenes.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

using std::chrono::microseconds;

TEST(RigidFriction, ASlidingCubeStopsWhereCoulombSaysWhateverTheDirectionAndTheTick)
{
    constexpr double speed = 0.5;
    for (const double angle : {0.0, 0.78539816339744831, 0.3}) {
        for (const int tick_us : {4000, 1000, 500}) {
            Description scene = platform();
            scene.bodies.push_back(cube_at({0.0, half, 0.0}));
            scene.bodies[0].velocity = {{speed * std::cos(angle), 0.0, speed * std::sin(angle)}};
            World world = world_of(scene, microseconds{tick_us});
            run(world, static_cast<std::uint64_t>(200'000 / tick_us));
            const BodyState state = world.body(0);
            const glm::dvec3 want{std::cos(angle), 0.0, std::sin(angle)};
            const double distance = speed * speed / (2.0 * friction * gravity);
            const glm::dvec3 went = state.position.value - glm::dvec3{0.0, half, 0.0};
            EXPECT_LT(length(went - distance * want), 1e-11 * distance);
            EXPECT_LT(rotated(state), 1e-12);
            EXPECT_LT(length(state.velocity.value), 1e-10);
        }
    }
}

TEST(RigidFriction, TorsionStopsASpinWhenTheMomentOfTheFacesPressureSays)
{
    Description scene = platform();
    scene.bodies.push_back(cube_at({0.0, half, 0.0}));
    scene.bodies[0].angular_velocity = {0.0, 20.0, 0.0};
    World world = world_of(scene);
    int ticks = 0;
    while (length(world.body(0).angular_velocity) > 1e-6 && ticks < 1000) {
        world.tick();
        ++ticks;
    }
    // Even pressure over a square: the mean distance from its middle is 0.7652 half edges.
    const double inertia = 2.0 / 3.0 * half * half; // per mass
    const double moment = friction * gravity * 0.7652 * half;
    EXPECT_NEAR(ticks, 20.0 * inertia / moment * 1e3, 1.5);
    EXPECT_LT(length(world.body(0).position.value - glm::dvec3{0.0, half, 0.0}), 1e-12);
}

TEST(RigidFriction, WhatFrictionHoldsOnASlopeStaysAndWhatItDoesNotSlidesDown)
{
    for (const double slope : {0.25, 0.4}) { // friction holds up to a slope of 0.3
        const double angle = std::atan(slope);
        Description scene = platform();
        scene.planes[0].normal = {std::sin(angle), std::cos(angle), 0.0};
        BodyDescription cube = cube_at(half * scene.planes[0].normal);
        cube.orientation = {std::cos(angle / 2.0), 0.0, 0.0, -std::sin(angle / 2.0)};
        scene.bodies.push_back(cube);
        World world = world_of(scene);
        run(world, 500);
        const double went = glm::dot(world.body(0).position.value,
                                     glm::dvec3{std::cos(angle), -std::sin(angle), 0});
        const double downhill = gravity * (std::sin(angle) - friction * std::cos(angle));
        EXPECT_NEAR(went, 0.5 * std::max(downhill, 0.0) * 0.25, 1e-9);
    }
}

TEST(RigidFriction, AStackOnAPushedCubeGoesWithIt)
{
    Description scene = stack_of(2);
    World world = world_of(scene);
    for (int i = 0; i < 200; ++i) {
        std::ignore = world.push(0, {{0.7, 0.0, 0.0}}); // 0.59 N holds both on the platform
        world.tick();
    }
    const double acceleration = 0.7 / 0.2 - friction * gravity;
    EXPECT_NEAR(world.body(0).position.x(), 0.5 * acceleration * 0.04, 1e-9);
    EXPECT_NEAR(world.body(1).position.x(), 0.5 * acceleration * 0.04, 1e-9);
}

} // namespace

} // namespace hapnet::scene
