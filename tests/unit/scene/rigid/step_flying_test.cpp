// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/rigid/scenes.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

BodyDescription flying(const glm::dvec3& place)
{
    BodyDescription body = cube_at(place);
    body.velocity = {{0.3, 1.0, -0.2}};
    body.angular_velocity = {3.0, -2.0, 5.0};
    return body;
}

/// Bodies far from each other: a cube, a brick, one that turns about an axis, one that cannot fall.
Description all_kinds()
{
    Description scene;
    scene.hands.count = 0;
    for (int i = 0; i < 4; ++i) scene.bodies.push_back(flying({1.0 * i, 0.0, 0.0}));
    scene.bodies[1].half = {0.01, 0.02, 0.03};
    scene.bodies[2].turning = Turning::about_y;
    scene.bodies[3].locked.y = true;
    return scene;
}

TEST(RigidFlight, IsThatOfABodyWithAPushOfNothing)
{
    for (const std::size_t kinds : {1U, 4U}) {
        Description scene = all_kinds();
        scene.bodies.resize(kinds);
        scene.bodies.push_back(flying({9.0, 0.0, 0.0}));
        World free = world_of(scene);
        World pushed = world_of(scene);
        for (int tick = 0; tick < 200; ++tick) {
            for (BodyId id = 0; id < scene.bodies.size(); ++id) pushed.push(id, {});
            pushed.tick();
            free.tick();
        }
        for (BodyId id = 0; id < scene.bodies.size(); ++id) {
            const BodyState a = free.body(id);
            const BodyState b = pushed.body(id);
            EXPECT_LE(length(a.position.value - b.position.value), 1e-14) << id;
            EXPECT_LE(length(a.velocity.value - b.velocity.value), 1e-13) << id;
            EXPECT_LE(length(a.angular_velocity - b.angular_velocity), 1e-12) << id;
            EXPECT_NEAR(std::abs(glm::dot(a.orientation, b.orientation)), 1.0, 1e-14) << id;
        }
    }
}

TEST(RigidFlight, OfOneAmongManyAtRestIsThatOfOneAlone)
{
    Description alone = platform();
    alone.bodies.push_back(flying({0.0, 1.0, 0.0}));
    Description among = platform();
    for (int i = 0; i < 9; ++i) among.bodies.push_back(cube_at({0.1 * i, half, 0.0}));
    among.bodies.insert(among.bodies.begin() + 4, alone.bodies[0]);
    World one = world_of(alone);
    World many = world_of(among);
    run(one, 300);
    run(many, 300);
    EXPECT_EQ(many.body(4).position.value, one.body(0).position.value);
    EXPECT_EQ(many.body(4).orientation, one.body(0).orientation);
    EXPECT_EQ(many.body(3).position.value, among.bodies[3].position.value);
}

TEST(RigidFlight, WithoutASpinKeepsTheOrientationToTheLastBit)
{
    Description scene = all_kinds();
    for (BodyDescription& body : scene.bodies) {
        body.turning = Turning::free;
        body.angular_velocity = {};
        body.orientation = base::normalized({0.3, 0.5, -0.7, 0.2});
    }
    for (const std::size_t kinds : {4U, 1U}) {
        scene.bodies.resize(kinds);
        World world = world_of(scene);
        const glm::dquat before = world.body(0).orientation;
        run(world, 500);
        for (BodyId id = 0; id < kinds; ++id) EXPECT_EQ(world.body(id).orientation, before);
    }
}

TEST(RigidFlight, EndsWhereABodyThatTurnedOnItsWayMeetsAnother)
{
    Description scene = platform();
    scene.bodies.push_back(cube_at({0.0, 0.5, 0.0}));
    scene.bodies[0].angular_velocity = {0.0, 4.0, 0.0};
    scene.bodies.push_back(cube_at({0.0, half, 0.0}));
    World world = world_of(scene);
    run(world, 800);
    EXPECT_NEAR(world.body(0).position.y(), 3.0 * half, 1e-6);
    EXPECT_NEAR(world.body(1).position.y(), half, 1e-6);
}

TEST(RigidFlight, AndContactsGoOnFromASnapshotBitByBit)
{
    Description scene = platform();
    for (int i = 0; i < 27; ++i) {
        scene.bodies.push_back(flying({0.05 * (i % 3), 0.05 + 0.05 * (i / 9), 0.05 * (i / 3 % 3)}));
        scene.bodies.back().velocity = {{std::sin(1.0 * i), 0.0, std::cos(2.0 * i)}};
    }
    World world = world_of(scene);
    run(world, 40);
    const World::Snapshot then = world.snapshot();
    run(world, 40);
    const std::uint64_t hash = world.hash();
    world.restore(then);
    run(world, 40);
    EXPECT_EQ(world.hash(), hash);
}

} // namespace

} // namespace hapnet::scene
