// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/rigid/scenes.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

using std::chrono::microseconds;

TEST(RigidRest, ACubeOnThePlatformDoesNotMoveByABit)
{
    Description scene = platform();
    scene.bodies.push_back(cube_at({0.0, half, 0.0}));
    World world = world_of(scene);
    run(world, 1000);
    EXPECT_EQ(world.body(0).position.value, glm::dvec3(0.0, half, 0.0));
    EXPECT_EQ(rotated(world.body(0)), 0.0);
}

TEST(RigidRest, AStackOfTenDriftsLessThanAMicrometreInTwoSeconds)
{
    const Description scene = stack_of(10);
    World world = world_of(scene);
    run(world, 2000);
    EXPECT_LT(drift(world, scene), 1e-6);
}

/// Cubes beside the middle, so that the stack tilts until its contacts carry its weight.
TEST(RigidRest, AStackOfFifteenIsAtRestAfterAFewTicks)
{
    Description scene = stack_of(15);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        glm::dvec3& place = scene.bodies[i].position.value;
        place.x = i % 2 == 0 ? -1e-4 : 1e-4;
        place.z = i % 3 == 0 ? -1e-4 : 5e-5;
    }
    World world = world_of(scene);
    run(world, 10);
    for (int i = 0; i < 1000; ++i) {
        world.tick();
        ASSERT_EQ(world.tick_cost().visits, scene.bodies.size()) << i; // a look at each contact
    }
    for (BodyId id = 0; id < scene.bodies.size(); ++id)
        EXPECT_LT(length(world.body(id).velocity.value), 1e-10) << id;
    EXPECT_LT(drift(world, scene), 1e-9);
}

TEST(RigidRest, TheStackStandsWithTicksFromAQuarterToFourMilliseconds)
{
    const Description scene = stack_of(10);
    for (const int tick_us : {250, 2000, 4000}) {
        World world = world_of(scene, microseconds{tick_us});
        run(world, static_cast<std::uint64_t>(1'000'000 / tick_us));
        EXPECT_LT(drift(world, scene), 50e-6) << tick_us << " us";
    }
}

TEST(RigidRest, AHundredKilogramsStandOnAHundredGrams)
{
    Description scene = stack_of(2);
    scene.bodies[1].mass_kg = 100.0;
    World world = world_of(scene);
    run(world, 2000);
    EXPECT_LT(drift(world, scene), 1e-6);
}

TEST(RigidRest, AStackThatFallsTogetherStandsStraight)
{
    Description scene = platform();
    for (const double i : {0.0, 1.0, 2.0, 3.0, 4.0}) {
        scene.bodies.push_back(cube_at({0.0, half + 0.001 + i * 0.045, 0.0}));
    }
    World world = world_of(scene);
    double before = energy(world);
    double most = 0.0;
    for (int i = 0; i < 600; ++i) {
        world.tick();
        const double now = energy(world);
        most = std::max(most, now - before);
        before = now;
    }
    EXPECT_LT(most, 1e-7); // J; the stack has 0.5 J
    for (BodyId id = 0; id < 5; ++id) {
        const BodyState state = world.body(id);
        EXPECT_NEAR(state.position.y(), half * (1.0 + 2.0 * id), 1e-6);
        EXPECT_LT(length({state.position.x(), 0.0, state.position.z()}), 1e-9);
        EXPECT_LT(length(state.velocity.value), 1e-6);
    }
}

TEST(RigidRest, WhatOverlapsIsMovedApartWithoutFlyingOff)
{
    Description scene = stack_of(2);
    scene.bodies[1].position.value.y -= 0.3 * half;
    World world = world_of(scene);
    double fastest = 0.0;
    for (int i = 0; i < 300; ++i) {
        world.tick();
        fastest = std::max(fastest, length(world.body(1).velocity.value));
    }
    EXPECT_LT(fastest, 1e-3);
    EXPECT_NEAR(world.body(1).position.y() - world.body(0).position.y(), 2.0 * half, 1e-6);
}

TEST(RigidRest, ATippingCubeGainsNoEnergyAndComesToRest)
{
    Description scene = platform();
    BodyDescription cube = cube_at({0.0, 0.0, 0.0});
    const double angle = 0.3;
    cube.orientation = {std::cos(angle / 2.0), 0.0, 0.0, std::sin(angle / 2.0)};
    cube.position.value.y = half * (std::cos(angle) + std::sin(angle));
    cube.material.friction = 2.0;
    scene.bodies.push_back(cube);
    World world = world_of(scene);
    const double start = energy(world);
    for (int i = 0; i < 500; ++i) {
        world.tick();
        EXPECT_LE(energy(world), start * (1.0 + 1e-12));
    }
    EXPECT_NEAR(world.body(0).position.y(), half, 1e-9);
    EXPECT_LT(length(world.body(0).velocity.value), 1e-9);
}

} // namespace

} // namespace hapnet::scene
