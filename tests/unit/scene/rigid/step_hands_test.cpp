// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/rigid/scenes.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

Description with_hands()
{
    Description scene = platform();
    scene.hands.count = 2;
    scene.bodies.push_back(cube_at({0.0, half, 0.0}));
    return scene;
}

HandInput hand_at(double x, double speed = 0.0)
{
    return {.position = {{x, half, 0.0}}, .velocity = {{speed, 0.0, 0.0}}};
}

TEST(RigidHands, ASqueezedCubeDoesNotMoveByABit)
{
    World world = world_of(with_hands());
    const double place = half + 0.005 - 0.001;
    for (int i = 0; i < 500; ++i) {
        std::ignore = world.set_hand(0, hand_at(-place));
        std::ignore = world.set_hand(1, hand_at(place));
        world.tick();
    }
    EXPECT_EQ(world.body(0).position.value, glm::dvec3(0.0, half, 0.0));
    EXPECT_EQ(rotated(world.body(0)), 0.0);
    EXPECT_NEAR(world.touch(0).on_body.x(), 0.5, 1e-12);
    EXPECT_EQ(world.touch(0).on_hand.x(), world.touch(1).on_body.x());
    EXPECT_NEAR(world.touch(1).depth_m, 0.001, 1e-15);
}

TEST(RigidHands, ASteadilyPushedCubeFeelsTheFrictionAndNoLag)
{
    Description scene = with_hands();
    scene.hands.damping_ns_per_m = 10.0;
    World world = world_of(scene);
    constexpr double speed = 0.1;
    const double force = friction * 0.1 * gravity;
    double x = -half - 0.005 - 0.0001;
    for (int i = 0; i < 1500; ++i) {
        std::ignore = world.set_hand(0, hand_at(x, speed));
        world.tick();
        x += speed * 1e-3;
    }
    EXPECT_NEAR(world.touch(0).on_body.x(), force, 1e-6);
    EXPECT_NEAR(world.body(0).velocity.x(), speed, 1e-6);
    EXPECT_NEAR(world.body(0).position.y(), half, 1e-9);
    EXPECT_LT(rotated(world.body(0)), 1e-6);
    // At the end of the tick spring and hand agree with this place, without an error of k v h.
    EXPECT_NEAR(x + 0.005 - (world.body(0).position.x() - half), force / 500.0, 1e-8);
}

TEST(RigidHands, AHeldCubeIsLiftedAndLetGo)
{
    Description scene = with_hands();
    scene.hands.stiffness_n_per_m = 2000.0;
    scene.hands.damping_ns_per_m = 20.0;
    World world = world_of(scene);
    HandInput hand{.position = {{0.0, 2.0 * half, 0.0}}, .gripping = true};
    for (int i = 0; i < 1000; ++i) {
        hand.position.value.y += 1e-4;
        hand.velocity = {{0.0, 0.1, 0.0}};
        std::ignore = world.set_hand(0, hand);
        world.tick();
    }
    EXPECT_TRUE(world.touch(0).holding);
    EXPECT_NEAR(world.body(0).position.y(), half + 0.1, 2e-3);
    hand.gripping = false;
    hand.present = false;
    std::ignore = world.set_hand(0, hand);
    run(world, 1000);
    EXPECT_FALSE(world.touch(0).holding);
    EXPECT_LT(world.body(0).position.y(), half * 1.8);
}

TEST(RigidHands, AFixedBoxIsFeltAndThePlatformIsNot)
{
    Description scene = with_hands();
    BodyDescription post = cube_at({0.5, half, 0.0});
    post.movable = false;
    scene.bodies.push_back(post);
    World world = world_of(scene);
    std::ignore = world.set_hand(0, hand_at(0.5 - half - 0.005 + 0.001));
    std::ignore = world.set_hand(1, {.position = {{0.2, -0.1, 0.0}}});
    world.tick();
    EXPECT_NEAR(world.touch(0).on_hand.x(), -0.5, 1e-12);
    EXPECT_FALSE(world.touch(0).touching);
    EXPECT_EQ(world.touch(1).on_hand, base::Force{});
}

} // namespace

} // namespace hapnet::scene
