// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::friction_test {
namespace {

constexpr double mass = 0.1;
constexpr double friction = 0.3;
constexpr double touching = 0.025;

TEST(OneBoxFriction, HoldsABoxExactlyUntilTheForceExceedsIt)
{
    Rig<true> rig{cube_on_platform(friction)};
    const double limit = friction * mass * 9.81;
    const auto push = [&](double force) {
        rig.state.pushes[0] = {0.6 * force, 0.0, 0.8 * force};
        rig.state.pushed.add(0);
        rig.tick();
        rig.state.pushed.clear();
    };
    for (int i = 0; i < 100; ++i) push((1.0 - 1e-12) * limit);
    EXPECT_EQ(rig.position(), glm::dvec3{0.0});
    push(1.5 * limit);
    const double acceleration = 0.5 * limit / mass;
    EXPECT_NEAR(rig.velocity().x, 0.6 * acceleration * 1e-3, 1e-17);
    EXPECT_NEAR(rig.velocity().z, 0.8 * acceleration * 1e-3, 1e-17);
}

TEST(OneBoxFriction, StartsWithinTheTickInWhichTheHandHasPressedEnough)
{
    Rig<true> rig{cube_on_platform(friction)};
    const double limit = friction * mass * 9.81;
    const double speed = 0.1;
    rig.set_hand(0, {-touching, 0.0, 0.0}, {speed, 0.0, 0.0});
    const double starts = limit / (500.0 * speed); // when the spring has reached the limit
    rig.carry(static_cast<int>(starts * 1000.0));
    EXPECT_EQ(rig.position(), glm::dvec3{0.0});
    rig.carry(1);
    const double since = std::ceil(starts * 1000.0) / 1000.0 - starts;
    const double frequency = std::sqrt(500.0 / mass);
    EXPECT_NEAR(rig.position().x, speed * (since - std::sin(frequency * since) / frequency), 1e-16);
}

TEST(OneBoxFriction, AHandFromAboveMakesItStopSooner)
{
    Rig<true> rig{cube_on_platform(friction)};
    rig.place({0.0, 0.0, 0.0}, {0.2, 0.0, 0.0});
    rig.set_hand(0, {0.0, touching - 0.002, 0.0}); // 1 N
    rig.tick(200);
    const double deceleration = friction * (9.81 + 1.0 / mass);
    EXPECT_NEAR(rig.position().x, 0.2 * 0.2 / (2.0 * deceleration), 1e-15);
    EXPECT_EQ(rig.position().y, 0.0);
}

TEST(OneBoxFriction, AHandThatComesDownMakesItGrowSteadily)
{
    Rig<true> rig{cube_on_platform(friction)};
    const double speed = 0.05;
    rig.place({0.0, 0.0, 0.0}, {0.3, 0.0, 0.0});
    rig.set_hand(0, {0.0, touching, 0.0}, {0.0, -speed, 0.0});
    rig.carry(50);
    const double t = 0.05;
    const double rise = friction * 500.0 * speed / mass;
    EXPECT_NEAR(rig.velocity().x, 0.3 - friction * 9.81 * t - 0.5 * rise * t * t, 1e-14);
    EXPECT_NEAR(rig.position().x, (0.3 - 0.5 * friction * 9.81 * t - rise * t * t / 6.0) * t,
                1e-14);
}

/// Returns the place after 64 ms of a box that is pushed across its direction.
glm::dvec3 turning(double tick)
{
    Rig<true> rig{cube_on_platform(friction), tick};
    rig.place({0.0, 0.0, 0.0}, {0.3, 0.0, 0.0});
    const int ticks = static_cast<int>(0.064 / tick + 0.5);
    for (int i = 0; i < ticks; ++i) {
        rig.state.pushes[0] = {0.0, 0.0, 0.4};
        rig.state.pushed.clear();
        rig.state.pushed.add(0);
        rig.tick();
    }
    return rig.position();
}

TEST(OneBoxFriction, IsOfSecondOrderWhereTheWayTurns)
{
    const glm::dvec3 truth = turning(0.064 / 4096);
    const auto error = [&](double tick) {
        const glm::dvec3 d = turning(tick) - truth;
        return std::sqrt(d.x * d.x + d.z * d.z);
    };
    EXPECT_LE(error(1e-3), 4e-7);
    EXPECT_NEAR(error(2e-3) / error(1e-3), 4.0, 0.3);
    EXPECT_NEAR(error(4e-3) / error(2e-3), 4.0, 0.5);
}

TEST(OneBoxFriction, OfAWallCountsToo)
{
    Description scene = lone_cube(); // no gravity: only the wall presses
    BodyDescription wall{.name = "wall", .movable = false};
    wall.position = {{0.04, 0.0, 0.0}};
    wall.half = {0.02, 0.5, 0.5};
    wall.material.friction = scene.bodies[0].material.friction = friction;
    scene.bodies.push_back(wall);
    Rig<true> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {0.0, 0.3, 0.0});
    rig.set_hand(0, {-touching + 0.002, 0.0, 0.0}); // 1 N against the wall
    rig.tick(50);
    EXPECT_NEAR(rig.velocity().y, 0.3 - friction * 1.0 / mass * 0.05, 1e-14);
}

} // namespace
} // namespace hapnet::scene::friction_test
