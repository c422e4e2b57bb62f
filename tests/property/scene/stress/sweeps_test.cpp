// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Stiffness, tick, mass ratio and speed, over their whole ranges.
#include "scene/world.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::sweeps_test {
namespace {

using namespace std::chrono_literals;

constexpr double half_edge = 0.02;
constexpr double mass = 0.1;

BodyDescription cube(const glm::dvec3& at, Turning turning = Turning::free)
{
    BodyDescription body;
    body.position.value = at;
    body.turning = turning;
    return body;
}

/// A cube in free space and hands without damping and limit, with k tick^2 / m = s.
Description floating(double s, Turning turning)
{
    Description scene;
    scene.bodies.push_back(cube(glm::dvec3{0.0}, turning));
    scene.gravity = glm::dvec3{0.0};
    scene.hands.stiffness_n_per_m = s * mass / 1e-6;
    scene.hands.damping_ns_per_m = 0.0;
    scene.hands.force_max_n = std::numeric_limits<double>::infinity();
    return scene;
}

World frozen(const Description& scene, std::optional<StepperKind> kind, bool sleeping = true)
{
    FreezeOptions options;
    options.stepper = kind;
    options.sleeping = sleeping;
    return World::freeze(scene, options).value();
}

void put_hand(World& world, std::uint32_t hand, const glm::dvec3& at)
{
    ASSERT_FALSE(world.set_hand(hand, {.position = {at}}));
}

class Stiffness : public ::testing::TestWithParam<double> {};

TEST_P(Stiffness, ABounceOffAHandKeepsTheEnergy)
{
    for (const StepperKind kind : {StepperKind::sliding, StepperKind::lone, StepperKind::many}) {
        const bool is_exact = kind == StepperKind::sliding;
        Description scene = floating(GetParam(), is_exact ? Turning::locked : Turning::free);
        scene.bodies[0].velocity.value = {0.5, 0.0, 0.0};
        World world = frozen(scene, kind);
        put_hand(world, 0, {half_edge + 0.0061, 0.0, 0.0});
        for (int i = 0; i < 200; ++i) world.tick();
        EXPECT_NEAR(world.body(0).velocity.x(), -0.5, 1e-9) << name_of(kind);
        EXPECT_NEAR(base::norm(world.body(0).velocity), 0.5, 1e-9) << name_of(kind);
    }
}

TEST_P(Stiffness, ASqueezedCubeSwingsNoFartherThanItBegan)
{
    for (const StepperKind kind : {StepperKind::sliding, StepperKind::lone, StepperKind::many}) {
        World world = frozen(
            floating(GetParam(), kind == StepperKind::sliding ? Turning::locked : Turning::free),
            kind);
        constexpr double pressed = 1e-3;
        put_hand(world, 0, {-half_edge - 0.005 + pressed, 0.0, 0.0});
        put_hand(world, 1, {half_edge + 0.005 - pressed, 0.0, 0.0});
        constexpr double off = 0.5 * pressed;
        ASSERT_FALSE(world.place(0, {.position = {{off, 0.0, 0.0}}}));
        double farthest = 0.0;
        for (int i = 0; i < 400; ++i) {
            world.tick();
            farthest = std::max(farthest, std::abs(world.body(0).position.x()));
        }
        EXPECT_LE(farthest, off * (1.0 + 1e-9)) << name_of(kind);
    }
}

INSTANTIATE_TEST_SUITE_P(Sweep, Stiffness,
                         ::testing::Values(0.01, 0.1, 0.32, 1.0, 1.8, 3.2, 10.0, 100.0, 1000.0));

class Tick : public ::testing::TestWithParam<std::chrono::microseconds> {};

TEST_P(Tick, AFallIsAParabola)
{
    Description scene;
    scene.hands.count = 0;
    scene.bodies.push_back(cube({0.0, 0.0, 0.0}));
    scene.bodies[0].velocity.value = {1.0, 2.0, -0.5};
    World world = World::freeze(scene, {.tick = GetParam(), .stepper = {}}).value();
    for (auto left = 1s / GetParam(); left > 0; --left) world.tick();
    EXPECT_NEAR(world.body(0).position.x(), 1.0, 1e-12);
    EXPECT_NEAR(world.body(0).position.y(), 2.0 - 0.5 * 9.81, 1e-12);
    EXPECT_NEAR(world.body(0).position.z(), -0.5, 1e-12);
}

TEST_P(Tick, AStackOfTenStands)
{
    Description scene;
    scene.planes.push_back({.name = "floor", .offset_m = -half_edge, .material = {0.5, 0.0}});
    scene.hands.count = 0;
    for (int i = 0; i < 10; ++i) {
        scene.bodies.push_back(cube({0.0, 2.0 * half_edge * i, 0.0}));
        scene.bodies.back().material.friction = 0.5;
    }
    World world =
        World::freeze(scene, {.tick = GetParam(), .sleeping = false, .stepper = {}}).value();
    for (auto left = 300ms / GetParam(); left > 0; --left) world.tick();
    for (BodyId id = 0; id < 10; ++id) {
        const auto moved = world.body(id).position - scene.bodies[id].position;
        EXPECT_LE(base::norm(moved), 50e-6) << id;
    }
}

INSTANTIATE_TEST_SUITE_P(Sweep, Tick, ::testing::Values(250us, 500us, 1000us, 2000us, 4000us));

TEST(MassRatio, TheHeavyStandsOnTheLightUpToAThousandToOne)
{
    for (const double ratio : {10.0, 100.0, 1000.0}) {
        Description scene;
        scene.planes.push_back({.name = "floor", .offset_m = -half_edge, .material = {0.5, 0.0}});
        scene.hands.count = 0;
        for (int i = 0; i < 2; ++i) {
            scene.bodies.push_back(cube({0.0, 2.0 * half_edge * i, 0.0}));
            scene.bodies.back().material.friction = 0.5;
        }
        scene.bodies[1].mass_kg = ratio * mass;
        World world = frozen(scene, StepperKind::few, false);
        for (int i = 0; i < 1000; ++i) world.tick();
        for (const BodyId id : {0U, 1U}) {
            const auto moved = world.body(id).position - scene.bodies[id].position;
            EXPECT_LE(base::norm(moved), 0.5e-3) << ratio;
        }
    }
}

TEST(Speed, NothingPassesAThinWallUpToAThousandMetresPerSecond)
{
    for (const StepperKind kind : {StepperKind::sliding, StepperKind::sliding_coulomb,
                                   StepperKind::lone, StepperKind::few, StepperKind::many}) {
        for (const double speed : {1.0, 10.0, 100.0, 1000.0}) {
            for (const double off : {0.0, 1e-4, 0.013}) {
                Description scene;
                scene.gravity = glm::dvec3{0.0};
                scene.bodies.push_back(cube({-0.3, off, -off}, kind <= StepperKind::sliding_coulomb
                                                                   ? Turning::locked
                                                                   : Turning::free));
                scene.bodies[0].velocity.value = {speed, 0.0, 0.0};
                BodyDescription wall;
                wall.movable = false;
                wall.half = {1e-3, 0.2, 0.2};
                scene.bodies.push_back(wall);
                World world = frozen(scene, kind);
                for (int i = 0; i < 2 + static_cast<int>(400.0 / speed); ++i) {
                    world.tick();
                    ASSERT_LT(world.body(0).position.x(), 0.0)
                        << name_of(kind) << ' ' << speed << ' ' << off;
                }
                EXPECT_GT(world.body(0).position.x(), -0.1) << name_of(kind) << ' ' << speed;
            }
        }
    }
}

} // namespace
} // namespace hapnet::scene::sweeps_test
