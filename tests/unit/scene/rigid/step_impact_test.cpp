// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/rigid/scenes.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

TEST(RigidImpact, AFlatHitOnAWallBouncesByItsRestitutionAtItsMoment)
{
    constexpr double speed = 0.5;
    for (const double restitution : {0.0, 0.5, 1.0}) {
        Description scene = platform();
        scene.planes[0].material = {};
        scene.planes.push_back({.name = "wall",
                                .normal = {-1.0, 0.0, 0.0},
                                .offset_m = -0.2,
                                .material = {.restitution = restitution}});
        scene.bodies.push_back(cube_at({0.0, half, 0.0}));
        scene.bodies[0].material = {};
        scene.bodies[0].velocity = {{speed, 0.0, 0.0}};
        World world = world_of(scene);
        double deepest = 0.0;
        for (int i = 0; i < 500; ++i) {
            world.tick();
            deepest = std::max(deepest, world.body(0).position.x() + half - 0.2);
        }
        const double after = 0.5 - (0.2 - half) / speed;
        EXPECT_NEAR(world.body(0).velocity.x(), -restitution * speed, 1e-11);
        EXPECT_NEAR(world.body(0).position.x(), 0.2 - half - restitution * speed * after, 1e-11);
        EXPECT_LE(deepest, 1e-14);
        EXPECT_LT(rotated(world.body(0)), 1e-11);
    }
}

TEST(RigidImpact, AnElasticCubeBouncesForEverAtItsEnergy)
{
    Description scene = platform();
    scene.planes[0].material.restitution = 1.0;
    scene.bodies.push_back(cube_at({0.0, 0.12, 0.0}));
    World world = world_of(scene);
    const double start = energy(world);
    run(world, 1500);
    EXPECT_NEAR(energy(world) / start, 1.0, 1e-12);
}

TEST(RigidImpact, NothingPassesAThinWallAtAThousandMetresPerSecond)
{
    for (const double restitution : {0.0, 1.0}) {
        for (const double speed : {3.0, 30.0, 1000.0}) {
            Description scene;
            scene.hands.count = 0;
            scene.gravity = glm::dvec3{0.0};
            BodyDescription wall = cube_at({5.0, 0.0, 0.0});
            wall.movable = false;
            wall.half = {0.002, 1.0, 1.0};
            wall.material = {.restitution = restitution};
            scene.bodies.push_back(wall);
            scene.bodies.push_back(cube_at(glm::dvec3{0.0}));
            scene.bodies[1].velocity = {{speed, 0.01 * speed, 0.0}};
            World world = world_of(scene);
            run(world, static_cast<std::uint64_t>(6000.0 / speed) + 10);
            EXPECT_LE(world.body(1).position.x(), 5.0 - 0.002 - half + 1e-10 * speed) << speed;
            EXPECT_NEAR(world.body(1).velocity.x(), -restitution * speed, 1e-9 * speed);
            EXPECT_LT(length(world.body(1).angular_velocity), 1e-9 * speed / half);
        }
    }
}

TEST(RigidImpact, OfTwoCubesThatMeetTheMomentumStays)
{
    for (const double speed : {1.0, 1000.0}) {
        Description scene;
        scene.hands.count = 0;
        scene.gravity = glm::dvec3{0.0};
        scene.bodies.push_back(cube_at({2.0, 0.0, 0.0}, 0.1));
        scene.bodies.push_back(cube_at({0.0, 0.0, 0.0}, 0.3));
        scene.bodies[1].velocity = {{speed, 0.0, 0.0}};
        World world = world_of(scene);
        run(world, static_cast<std::uint64_t>(2500.0 / speed) + 10);
        EXPECT_NEAR(world.body(0).velocity.x(), 0.75 * speed, 1e-9 * speed);
        EXPECT_NEAR(world.body(1).velocity.x(), 0.75 * speed, 1e-9 * speed);
        EXPECT_NEAR(world.body(0).position.x() - world.body(1).position.x(), 2.0 * half, 1e-6);
    }
}

TEST(RigidImpact, ATumblingHeapComesToRestAndGainsNoEnergyToSpeakOf)
{
    Description scene = platform();
    for (const double i : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        BodyDescription cube = cube_at({0.013 * i - 0.02, 0.05 + 0.06 * i, 0.007 * i});
        const glm::dquat turn{1.0, 0.3 * i, 0.7 - 0.2 * i, 0.1};
        cube.orientation = turn / std::sqrt(glm::dot(turn, turn));
        scene.bodies.push_back(cube);
    }
    World world = world_of(scene);
    const double start = energy(world);
    double before = start;
    double gained = 0.0;
    for (int i = 0; i < 1500; ++i) {
        world.tick();
        const double now = energy(world);
        gained += std::max(0.0, now - before);
        before = now;
    }
    EXPECT_LT(gained, 2e-3 * start);
    for (BodyId id = 0; id < 6; ++id) {
        EXPECT_LT(length(world.body(id).velocity.value), 1e-3);
        EXPECT_GT(world.body(id).position.y(), half * 0.999);
    }
}

} // namespace

} // namespace hapnet::scene
