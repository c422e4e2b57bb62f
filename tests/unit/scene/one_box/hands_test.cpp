// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr double mass = 0.1;
constexpr double touching = 0.025;

TEST(BoxHands, GiveTheBoxExactlyTheImpulseThatTheyReport)
{
    Description scene = lone_cube();
    scene.hands.damping_ns_per_m = 2.0;
    scene.hands.force_max_n = 1.0;
    Rig<false> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {-0.1, 0.0, 0.0});
    rig.set_hand(0, {-touching - 0.002, 0.0, 0.0}, {0.15, 0.0, 0.0});
    for (int i = 0; i < 60; ++i) {
        const double before = rig.velocity().x;
        rig.carry(1);
        EXPECT_NEAR(mass * (rig.velocity().x - before), 1e-3 * rig.touch(0).on_body.x(), 1e-16);
        EXPECT_EQ(rig.touch(0).on_body.x(), -rig.touch(0).on_hand.x());
    }
}

TEST(BoxHands, KeepTheFaceThroughWhichTheyCame)
{
    Rig<false> rig{lone_cube()};
    rig.config.hands.force_max_n = 0.0; // so that the box stays where it is
    rig.set_hand(0, {-0.024, 0.012, 0.0}, {2.0, 0.0, 0.0});
    rig.carry(1);
    for (int i = 0; i < 10; ++i) rig.carry(1); // now the upper face is nearer
    EXPECT_NEAR(rig.touch(0).depth_m, touching - 0.024 + 0.020, 1e-15);
}

TEST(BoxHands, AreFeltAtTheFaceTheyReachedWhenTheyPassRightThrough)
{
    Description scene = lone_cube();
    scene.hands.force_max_n = 3.3;
    Rig<false> rig{scene};
    rig.set_hand(0, {-0.5, 0.001, 0.0}, {1000.0, 0.0, 0.0});
    rig.tick();
    EXPECT_GT(rig.touch(0).on_body.x(), 1.0);
    EXPECT_EQ(rig.touch(0).on_body.y(), 0.0);
}

TEST(BoxHands, PushObliquelyAtAnEdgeWithoutMakingEnergy)
{
    Rig<false> rig{lone_cube()};
    rig.place({0.0, 0.0, 0.0}, {0.1, 0.1, 0.0});
    rig.set_hand(0, {0.0241, 0.0241, 0.0});
    for (int i = 0; i < 60; ++i) rig.tick();
    EXPECT_LT(rig.velocity().x, 0.0);
    const double speed_squared =
        glm::dvec3{rig.velocity()}.x * rig.velocity().x + rig.velocity().y * rig.velocity().y;
    EXPECT_NEAR(speed_squared, 0.02, 0.02 * 0.01); // a midpoint rule with a first touch by halves
    EXPECT_NEAR(rig.velocity().x, rig.velocity().y, 1e-12);
}

TEST(BoxHands, WhoHoldsTheBoxSwingsItAboutThePlaceWhereTheyTookIt)
{
    Description scene = lone_cube();
    Rig<false> rig{scene};
    rig.set_hand(0, {-0.027, 0.0, 0.003}); // not touching: within reach of the grip
    rig.state.hands[0].gripping = true;
    rig.place({0.0, 0.0, 0.0}, {0.05, -0.03, 0.02});
    const double frequency = std::sqrt(500.0 / mass);
    for (int i = 1; i <= 200; ++i) {
        rig.tick();
        const double swing = std::sin(frequency * 1e-3 * i) / frequency;
        EXPECT_NEAR(rig.position().x, 0.05 * swing, 1e-15);
        EXPECT_NEAR(rig.position().y, -0.03 * swing, 1e-15);
        EXPECT_NEAR(rig.position().z, 0.02 * swing, 1e-15);
        EXPECT_TRUE(rig.touch(0).holding);
    }
    rig.state.hands[0].gripping = false;
    rig.tick();
    EXPECT_FALSE(rig.touch(0).holding);
}

TEST(BoxHands, CannotHoldWhatIsOutOfReach)
{
    Rig<false> rig{lone_cube()};
    rig.set_hand(0, {-0.0301, 0.0, 0.0});
    rig.state.hands[0].gripping = true;
    rig.tick();
    EXPECT_FALSE(rig.touch(0).holding);
    EXPECT_FALSE(rig.touch(0).touching);
}

TEST(BoxHands, HoldWithNoMoreThanTheGreatestForce)
{
    Description scene = lone_cube();
    scene.hands.force_max_n = 0.5;
    Rig<false> rig{scene};
    rig.set_hand(0, {-0.021, 0.0, 0.0});
    rig.state.hands[0].gripping = true;
    rig.tick();
    rig.set_hand(0, {-0.021 - 0.03, 0.0, 0.04});
    rig.state.hands[0].gripping = true;
    rig.tick();
    EXPECT_NEAR(rig.touch(0).on_body.x(), -0.3, 1e-15);
    EXPECT_NEAR(rig.touch(0).on_body.z(), 0.4, 1e-15);
    EXPECT_NEAR(rig.velocity().z, 0.4 * 1e-3 / mass, 1e-15);
}

TEST(BoxHands, FeelFixedBoxesByTheMeanForceButNotPlanes)
{
    Description scene = cube_on_platform();
    scene.hands.damping_ns_per_m = 2.0;
    BodyDescription fixed{.name = "fixed", .movable = false};
    fixed.position = {{0.2, 0.0, 0.0}};
    scene.bodies.push_back(fixed);
    Rig<false> rig{scene};
    const double speed = 0.1; // it touches in the middle of the tick
    rig.set_hand(0, {0.2 - touching - 0.5e-3 * speed, 0.0, 0.0}, {speed, 0.0, 0.0});
    rig.set_hand(1, {0.1, -0.03, 0.0}); // in the platform
    rig.tick();
    const double impulse = 2.0 * speed * 0.5e-3 + 0.5 * 500.0 * speed * 0.25e-6;
    EXPECT_NEAR(rig.touch(0).on_hand.x(), -impulse / 1e-3, 1e-10);
    EXPECT_EQ(rig.touch(0).on_body, base::Force{});
    EXPECT_FALSE(rig.touch(0).touching);
    EXPECT_EQ(rig.touch(1).on_hand, base::Force{});
}

TEST(BoxHands, ThatAreAbsentLeaveTheBoxAlone)
{
    Rig<false> rig{lone_cube()};
    rig.set_hand(0, {-0.02, 0.0, 0.0});
    rig.state.hands[0].present = false;
    rig.tick();
    EXPECT_EQ(rig.velocity(), glm::dvec3{0.0});
}

} // namespace
} // namespace hapnet::scene
