// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

BodyDescription fixed_at(const glm::dvec3& position, const glm::dvec3& half = glm::dvec3{0.02})
{
    BodyDescription box{.name = "fixed", .movable = false};
    box.position = {position};
    box.half = half;
    return box;
}

TEST(OneBoxObstacles, ABouncingBoxComesToRestExactlyOnThePlane)
{
    Description scene = cube_on_platform();
    scene.bodies[0].material.restitution = 0.5;
    Rig<false> rig{scene};
    rig.place({0.0, 0.01, 0.0});
    const double fall = std::sqrt(2.0 * 0.01 / 9.81);
    const int ticks = static_cast<int>(1.5 * fall * 1000.0); // the top of the first bounce
    for (int i = 0; i < ticks; ++i) rig.tick();
    const double since = ticks * 1e-3 - fall;
    const double speed = 0.5 * 9.81 * fall;
    EXPECT_NEAR(rig.position().y, since * (speed - 0.5 * 9.81 * since), 1e-14);
    for (int i = 0; i < 300; ++i) {
        rig.tick();
        EXPECT_GE(rig.position().y, 0.0);
    }
    EXPECT_EQ(rig.position().y, 0.0);
    EXPECT_EQ(rig.velocity().y, 0.0);
    EXPECT_EQ(rig.stepper.crowded_ticks(), 0U);
}

TEST(OneBoxObstacles, AnElasticBoxBouncesToTheSameHeightForTenSeconds)
{
    Description scene = cube_on_platform();
    scene.bodies[0].material.restitution = 1.0;
    Rig<false> rig{scene};
    rig.place({0.0, 0.05, 0.0});
    rig.tick(10000);
    const double height = rig.position().y + rig.velocity().y * rig.velocity().y / (2.0 * 9.81);
    EXPECT_NEAR(height, 0.05, 1e-9 * 0.05);
}

TEST(OneBoxObstacles, NoSpeedPassesAThinWall)
{
    for (const double speed : {1.0, 30.0, 1000.0, 10000.0}) {
        Description scene = lone_cube();
        scene.bodies.push_back(fixed_at({0.5, 0.0, 0.0}, {1e-4, 0.1, 0.1}));
        Rig<false> rig{scene};
        rig.place({0.0, 0.0, 0.0}, {speed, 0.0, 0.0});
        rig.tick(static_cast<int>(600.0 / speed) + 2);
        EXPECT_EQ(rig.position().x, 0.5 - (1e-4 + 0.02)) << speed;
        EXPECT_EQ(rig.velocity().x, 0.0);
    }
}

TEST(OneBoxObstacles, ItSlidesOffTheEdgeOfABoxAndFalls)
{
    Description scene = lone_cube();
    scene.gravity = {0.0, -9.81, 0.0};
    scene.bodies.push_back(fixed_at({0.0, -0.04, 0.0}));
    Rig<false> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {0.3, 0.0, 0.0});
    rig.tick(200);
    const double gravity_on = 0.2 - 0.04 / 0.3;
    EXPECT_NEAR(rig.position().x, 0.06, 1e-15);
    EXPECT_NEAR(rig.position().y, -0.5 * 9.81 * gravity_on * gravity_on, 1e-15);
}

TEST(OneBoxObstacles, ItCrossesTheSeamsOfATiledFloorWithoutNoticing)
{
    Description scene = lone_cube();
    scene.gravity = {0.0, -9.81, 0.0};
    for (const double x : {0.0, 0.04, 0.08, 0.12}) {
        scene.bodies.push_back(fixed_at({x, -0.04, 0.0}));
    }
    Rig<false> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {0.3, 0.0, 0.0});
    rig.tick(400);
    EXPECT_NEAR(rig.position().x, 0.12, 1e-14);
    EXPECT_EQ(rig.position().y, 0.0);
}

TEST(OneBoxObstacles, ItPassesABoxThatItDoesNotMeet)
{
    Description scene = lone_cube();
    scene.bodies.push_back(fixed_at({0.1, 0.0401, 0.0}));
    Rig<false> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
    rig.tick(200);
    EXPECT_NEAR(rig.position().x, 0.2, 1e-14);
}

TEST(OneBoxObstacles, ADeepBoxIsPutOutThroughTheNearestFace)
{
    Description scene = lone_cube();
    scene.bodies.push_back(fixed_at({0.0, 0.0, 0.0}));
    Rig<false> rig{scene};
    rig.place({0.005, -0.012, 0.001});
    rig.tick();
    EXPECT_EQ(rig.position(), (glm::dvec3{0.005, -0.04, 0.001}));
    EXPECT_EQ(rig.velocity(), glm::dvec3{0.0});
}

TEST(OneBoxObstacles, PressedIntoAWallByAHandItStaysAtTheWall)
{
    Description scene = lone_cube();
    scene.bodies.push_back(fixed_at({0.05, 0.0, 0.0}));
    scene.bodies[0].material.restitution = 0.8;
    Rig<false> rig{scene};
    rig.set_hand(0, {-0.03, 0.0, 0.0}, {0.1, 0.0, 0.0});
    for (int i = 0; i < 500; ++i) {
        rig.carry(1);
        if (i == 200) rig.state.hands[0].velocity = {};
        EXPECT_LE(rig.position().x, 0.05 - 0.04);
    }
    EXPECT_EQ(rig.position().x, 0.05 - 0.04);
    EXPECT_EQ(rig.velocity().x, 0.0);
    EXPECT_GT(rig.touch(0).on_body.x(), 0.5);
}

TEST(OneBoxObstacles, LockedAxesKeepTheirCoordinate)
{
    Description scene = lone_cube();
    scene.gravity = {0.0, -9.81, 0.0};
    scene.bodies[0].locked.y = true;
    Rig<false> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {0.1, 0.0, 0.0});
    rig.tick(100);
    EXPECT_EQ(rig.position().y, 0.0);
    EXPECT_NEAR(rig.position().x, 0.01, 1e-15);
}

} // namespace
} // namespace hapnet::scene
