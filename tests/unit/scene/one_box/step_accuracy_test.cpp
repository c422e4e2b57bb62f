// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr double mass = 0.1;
constexpr double touching = 0.025; // a hand's centre from the cube's when they just touch

TEST(OneBox, FliesAParabolaForASecondWithin1e12Metres)
{
    Description scene = lone_cube();
    scene.gravity = {0.0, -9.81, 0.0};
    Rig<false> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {0.3, 4.0, -0.2});
    rig.tick(1000);
    EXPECT_NEAR(rig.position().x, 0.3, 1e-12);
    EXPECT_NEAR(rig.position().y, 4.0 - 0.5 * 9.81, 1e-12);
    EXPECT_NEAR(rig.position().z, -0.2, 1e-12);
}

TEST(OneBox, DryFrictionStopsItWhereCoulombSaysAtAnyAngle)
{
    const double friction = 0.3;
    const double speed = 0.5;
    const double distance = speed * speed / (2.0 * friction * 9.81);
    for (const double angle : {0.0, 0.25, 0.78539816339744830962, 1.1}) {
        Rig<true> rig{cube_on_platform(friction)};
        const glm::dvec3 direction{std::cos(angle), 0.0, std::sin(angle)};
        rig.place({0.0, 0.0, 0.0}, speed * direction);
        rig.tick(200);
        EXPECT_NEAR(rig.position().x, distance * direction.x, 1e-13 * distance) << angle;
        EXPECT_NEAR(rig.position().z, distance * direction.z, 1e-13 * distance) << angle;
        EXPECT_EQ(rig.position().y, 0.0);
        EXPECT_EQ(rig.velocity(), glm::dvec3{0.0});
    }
}

TEST(OneBox, DragOnAPlaneBringsItToRestWhereItShould)
{
    Rig<false> rig{cube_on_platform(0.0, 10.0)};
    rig.place({0.0, 0.0, 0.0}, {0.3, 0.0, 0.1});
    rig.tick(1000); // 100 time constants
    EXPECT_NEAR(rig.position().x, 0.3 * mass / 10.0, 1e-16);
    EXPECT_NEAR(rig.position().z, 0.1 * mass / 10.0, 1e-16);
}

TEST(OneBox, ABounceOnAHandKeepsItsEnergyForEveryStiffnessAndTick)
{
    for (const double stiffness : {0.01, 0.1, 0.32, 1.0, 3.2, 10.0, 100.0, 1000.0}) {
        for (const double tick : {4e-3, 2e-3, 1e-3, 0.5e-3, 0.25e-3}) {
            Description scene = lone_cube();
            scene.hands.stiffness_n_per_m = stiffness * mass / (tick * tick);
            Rig<false> rig{scene, tick};
            const double speed = 0.1;
            rig.place({0.00123, 0.0, 0.0}, {-speed, 0.0, 0.0});
            rig.set_hand(0, {-touching, 0.0, 0.0});
            const double contact = 3.15 / std::sqrt(stiffness) * tick;
            const int ticks = static_cast<int>((contact + 0.015) / tick) + 2;
            for (int i = 0; i < ticks; ++i) rig.tick();
            EXPECT_GT(rig.position().x, 0.0);
            EXPECT_NEAR(rig.velocity().x, speed, 1e-11 * speed) << stiffness << ' ' << tick;
        }
    }
}

TEST(OneBox, ASteadyPushAgainstDragHasNoLagAndNoRipple)
{
    Description scene = cube_on_platform(0.0, 10.0);
    scene.hands.damping_ns_per_m = 2.0;
    Rig<false> rig{scene};
    const double speed = 0.1;
    const double depth = 10.0 * speed / 500.0;
    rig.place({0.0, 0.0, 0.0}, {speed, 0.0, 0.0});
    rig.set_hand(0, {-touching + depth, 0.0, 0.0}, {speed, 0.0, 0.0});
    for (int i = 0; i < 500; ++i) {
        rig.carry(1);
        EXPECT_NEAR(rig.touch(0).on_body.x(), 1.0, 1e-12);
        EXPECT_NEAR(rig.position().x - rig.state.hands[0].position.x(), touching - depth, 1e-15);
    }
}

TEST(OneBox, ASteadyPushAgainstDryFrictionSettlesAtTheFrictionForce)
{
    const double friction = 0.3;
    Description scene = cube_on_platform(friction);
    scene.hands.damping_ns_per_m = 2.0;
    Rig<true> rig{scene};
    const double speed = 0.1;
    rig.place({0.0, 0.0, 0.0}, {});
    rig.set_hand(0, {-touching, 0.0, 0.0}, {speed, 0.0, 0.0});
    rig.carry(6000);
    const double force = friction * mass * 9.81;
    for (int i = 0; i < 100; ++i) {
        rig.carry(1);
        EXPECT_NEAR(rig.touch(0).on_body.x(), force, 1e-9);
        EXPECT_NEAR(rig.position().x - rig.state.hands[0].position.x(), touching - force / 500.0,
                    1e-9);
    }
    EXPECT_EQ(rig.stepper.crowded_ticks(), 0U);
}

TEST(OneBox, ASymmetricSqueezeDoesNotDriftAtAll)
{
    Description scene = cube_on_platform(0.0, 10.0);
    scene.hands.damping_ns_per_m = 2.0;
    Rig<false> rig{scene};
    rig.set_hand(0, {-touching + 0.003, 0.0, 0.001});
    rig.set_hand(1, {touching - 0.003, 0.0, 0.001});
    rig.tick(10000);
    EXPECT_EQ(rig.position(), glm::dvec3{0.0});
    EXPECT_EQ(rig.velocity(), glm::dvec3{0.0});
    EXPECT_NEAR(rig.touch(0).on_hand.x(), -1.5, 1e-12);
    EXPECT_EQ(rig.touch(0).on_hand.x(), -rig.touch(1).on_hand.x());
}

TEST(OneBox, BetweenTwoHandsItOscillatesForTenSecondsWithoutLosingAnything)
{
    for (const double tick : {4e-3, 1e-3, 0.25e-3}) {
        Description scene = lone_cube();
        scene.hands.stiffness_n_per_m = 1000.0;
        Rig<false> rig{scene, tick};
        const double start = 0.001;
        rig.place({start, 0.0, 0.0}, {});
        rig.set_hand(0, {-touching + 0.004, 0.0, 0.0});
        rig.set_hand(1, {touching - 0.004, 0.0, 0.0});
        const double frequency = std::sqrt(2.0 * 1000.0 / mass);
        const int ticks = static_cast<int>(10.0 / tick);
        for (int i = 1; i <= ticks; ++i) {
            rig.tick();
            const double expected = start * std::cos(frequency * tick * i);
            ASSERT_NEAR(rig.position().x, expected, 1e-10 * start) << tick << ' ' << i;
        }
    }
}

TEST(OneBox, ItBouncesOffAWallByTheRestitutionAndNeverEntersIt)
{
    for (const double restitution : {0.0, 0.5, 1.0}) {
        Description scene = cube_on_platform();
        BodyDescription wall{.name = "wall", .movable = false};
        wall.position = {{0.1, 0.0, 0.0}};
        wall.material.restitution = restitution;
        scene.bodies.push_back(wall);
        Rig<false> rig{scene};
        rig.place({0.0, 0.0, 0.0}, {0.3, 0.0, 0.0});
        const double face = 0.1 - 0.04;
        for (int i = 0; i < 400; ++i) {
            rig.tick();
            EXPECT_LE(rig.position().x, face);
        }
        EXPECT_NEAR(rig.velocity().x, -restitution * 0.3, 1e-15);
        const double since = 0.4 - face / 0.3;
        EXPECT_NEAR(rig.position().x, face - restitution * 0.3 * since, 1e-13);
        if (restitution == 0.0) {
            EXPECT_EQ(rig.position().x, face);
        }
    }
}

} // namespace
} // namespace hapnet::scene
