// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Kinematic bodies: how they carry, push and turn other bodies, against formulas.
#include "proto/base/math.hpp"
#include "scene/query.hpp"
#include "scene/rigid/driven_energy.hpp"
#include "scene/text/text.hpp"
#include "tests/support/scene/bench_scenes.hpp"
#include "tests/unit/scene/rigid/scenes.hpp"

#include <array>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::kinematic_test {
namespace {

using namespace std::chrono_literals;

constexpr double tick_s = 1e-3;
constexpr double slip_limit = friction * gravity; // m/s^2

/// A plate of 2 m that moves by itself, its surface at y = 0, with a cube on it.
Description plate_with_cube()
{
    Description scene;
    scene.hands.count = 0;
    scene.bodies.push_back(cube_at({0.0, half, 0.0}));
    BodyDescription plate{.name = "plate", .movable = false, .kinematic = true};
    plate.half = {1.0, 0.01, 1.0};
    plate.position = {{0.0, -0.01, 0.0}};
    plate.material.friction = friction;
    scene.bodies.push_back(plate);
    return scene;
}

TEST(DrivenEnergy, IsAtMostWhatTheOtherTakes)
{
    EXPECT_NEAR(driven_energy(5.0, 2.0), 2.0, 1e-11);
    EXPECT_DOUBLE_EQ(driven_energy(1.0, 2.0), 1.0);
    EXPECT_DOUBLE_EQ(driven_energy(-1.0, 2.0), -1.0);
}

TEST(Kinematic, ACubeOnAPlateThatStartsAtOnceSlidesUntilItGoesAlong)
{
    for (const base::Duration tick : {base::Duration{1ms}, base::Duration{250us}}) {
        constexpr double speed = 0.5;
        Description scene = plate_with_cube();
        scene.bodies[1].velocity = {{speed, 0.0, 0.0}};
        World world = World::freeze(scene, {.tick = tick, .sleeping = true}).value();
        EXPECT_EQ(world.stepper_kind(), StepperKind::lone);
        const int ticks = static_cast<int>(std::lround(1.0 / base::to_seconds(tick)));
        for (int i = 0; i < ticks / 10; ++i) world.tick();
        EXPECT_NEAR(world.velocity(0).x(), 0.1 * slip_limit, 1e-10);
        EXPECT_NEAR(world.position(0).x(), 0.5 * slip_limit * 0.01, 1e-10);
        for (int i = ticks / 10; i < ticks; ++i) world.tick();
        EXPECT_NEAR(world.velocity(0).x(), speed, 1e-12);
        const double behind = world.position(1).x() - world.position(0).x();
        EXPECT_NEAR(behind, 0.5 * speed * speed / slip_limit, 1e-9);
        EXPECT_NEAR(world.position(0).y(), half, 1e-12);
        EXPECT_LE(rotated(world.body(0)), 1e-9);
    }
}

/// Moves the plate at a constant acceleration, tick by tick.
void accelerate(World& world, double acceleration, int ticks)
{
    for (int i = 1; i <= ticks; ++i) {
        const double time = i * tick_s;
        BodyState target = world.body(1);
        target.position.value.x = 0.5 * acceleration * time * time;
        target.velocity.value.x = acceleration * time;
        ASSERT_FALSE(world.move(1, target));
        world.tick();
    }
}

TEST(Kinematic, ACubeSticksToAPlateThatAcceleratesLessThanFrictionCan)
{
    World world = world_of(plate_with_cube());
    accelerate(world, 0.9 * slip_limit, 500);
    EXPECT_NEAR(world.position(0).x(), world.position(1).x(), 1e-12);
    EXPECT_NEAR(world.velocity(0).x(), world.velocity(1).x(), 1e-12);
    EXPECT_NEAR(world.position(1).x(), 0.5 * 0.9 * slip_limit * 0.25, 1e-12);
}

TEST(Kinematic, ACubeSlipsOnOneThatAcceleratesMoreByTheDifference)
{
    World world = world_of(plate_with_cube());
    accelerate(world, 2.0 * slip_limit, 300);
    EXPECT_NEAR(world.position(0).x(), 0.5 * slip_limit * 0.09, 1e-11);
    EXPECT_NEAR(world.velocity(0).x(), slip_limit * 0.3, 1e-11);
}

TEST(Kinematic, AWallThatComesTakesACubeAlongOrThrowsItTwiceAsFast)
{
    for (const double restitution : {0.0, 1.0}) {
        Description scene = plate_with_cube();
        scene.gravity = glm::dvec3{0.0};
        scene.bodies[0].position = {{0.0, 0.0, 0.0}};
        scene.bodies[1].half = {0.01, 0.1, 0.1};
        scene.bodies[1].position = {{-0.05, 0.0, 0.0}};
        scene.bodies[1].velocity = {{0.7, 0.0, 0.0}};
        scene.bodies[1].material = {0.0, restitution};
        World world = world_of(scene);
        run(world, 100);
        EXPECT_NEAR(world.velocity(0).x(), (1.0 + restitution) * 0.7, 1e-12);
        EXPECT_NEAR(world.position(1).x(), 0.02, 1e-14);
        // They met after (50 - 10 - 20) mm.
        const double since = 0.1 - 0.02 / 0.7;
        EXPECT_NEAR(world.position(0).x(), (1.0 + restitution) * 0.7 * since, 1e-6);
        EXPECT_LE(rotated(world.body(0)), 1e-9);
    }
}

/// A smooth ball between two smooth plates at an angle a, one of which closes. It leaves along the
/// plate that rests, with the speed over sin(a).
World scissors(double angle, double speed)
{
    constexpr double radius = 0.02;
    Description scene;
    scene.gravity = glm::dvec3{0.0};
    scene.hands.count = 0;
    BodyDescription ball{.name = "ball", .shape = Shape::sphere};
    ball.half = glm::dvec3{radius};
    ball.material = {0.0, 0.0};
    scene.bodies.push_back(ball);
    for (const bool closes : {false, true}) {
        BodyDescription plate{.name = closes ? "closes" : "stays", .movable = false};
        plate.kinematic = closes;
        plate.half = {1.0, 0.01, 1.0};
        plate.material = {0.0, 0.0};
        const double turn = closes ? 0.5 * angle : -0.5 * angle;
        plate.orientation = {std::cos(0.5 * turn), 0.0, 0.0, std::sin(0.5 * turn)};
        const glm::dvec3 up = plate.orientation * glm::dvec3{0.0, closes ? 1.0 : -1.0, 0.0};
        plate.position = {(radius + 0.01) * up};
        if (closes) plate.velocity = {-speed * up};
        scene.bodies.push_back(plate);
    }
    return world_of(scene);
}

TEST(Kinematic, TwoThatCloseLikeScissorsSqueezeABallOutFasterThanTheyAre)
{
    constexpr double angle = 0.3, speed = 0.02;
    World world = scissors(angle, speed);
    run(world, 100);
    EXPECT_EQ(world.state().interventions.guards(), 0U);
    // Along the middle, with half of the closing speed over the sine of half of the angle.
    EXPECT_NEAR(std::abs(world.velocity(0).x()), 0.5 * speed / std::sin(0.5 * angle), 1e-3 * speed);
}

TEST(Kinematic, ScissorsThatAreNearlyParallelThrowNothingAtMoreThanTenTimesTheirSpeed)
{
    constexpr double speed = 0.02;
    World world = scissors(0.02, speed); // 50 times the speed without a limit
    for (int i = 0; i < 100; ++i) {
        world.tick();
        ASSERT_LE(length(world.velocity(0).value), 10.5 * speed) << i;
    }
    const Interventions& counted = world.state().interventions;
    EXPECT_GT(counted.islands_limited + counted.impulses_trimmed, 0U);
}

/// A hand that gives way as fast as a wall drives the cube onto it gets the wall's force.
TEST(Kinematic, ACubeThatAWallPushesAlongAHandThatGivesWayIsFeltWhole)
{
    constexpr double speed = 0.7, depth = 1e-4, stiffness = 500.0, radius = 0.005;
    Description scene;
    scene.gravity = glm::dvec3{0.0};
    scene.hands.count = 1;
    scene.hands.radius_m = radius;
    scene.hands.stiffness_n_per_m = stiffness;
    scene.hands.damping_ns_per_m = 0.0;
    scene.bodies.push_back(cube_at({0.0, 0.0, 0.0}));
    scene.bodies[0].velocity = {{speed, 0.0, 0.0}};
    BodyDescription wall{.name = "wall", .movable = false, .kinematic = true};
    wall.half = {0.01, 0.1, 0.1};
    wall.position = {{-half - 0.01, 0.0, 0.0}};
    wall.velocity = {{speed, 0.0, 0.0}};
    scene.bodies.push_back(wall);
    World world = world_of(scene);
    for (int i = 0; i < 50; ++i) {
        const double place = half + radius - depth + speed * tick_s * i;
        ASSERT_FALSE(world.set_hand(0, {{{place, 0.0, 0.0}}, {{speed, 0.0, 0.0}}}));
        world.tick();
        ASSERT_NEAR(length(world.touch(0).on_hand.value), stiffness * depth,
                    1e-3 * stiffness * depth)
            << i;
    }
    EXPECT_EQ(world.state().interventions.guards(), 0U);
    EXPECT_NEAR(world.velocity(0).x(), speed, 1e-9);
}

TEST(Kinematic, ALiftCarriesWhatItAcceleratesAndAContactTellsTheLoad)
{
    Description scene = plate_with_cube();
    scene.bodies[1].sway = {{0.0, 0.1, 0.0}, 2s};
    World world = world_of(scene);
    std::array<Contact, 2> found;
    double worst = 0.0;
    for (int i = 1; i <= 3000; ++i) {
        world.tick();
        const double height = 0.05 * (1.0 - base::cos(base::two_pi * i * tick_s / 2.0));
        ASSERT_NEAR(world.position(1).y(), height - 0.01, 1e-14);
        ASSERT_NEAR(world.position(0).y(), height + half, 2.5e-6 * half); // within 2e-6: touching
        ASSERT_EQ(contacts(world, found), 1U);
        const double angle = base::two_pi * (i - 0.5) * tick_s / 2.0;
        const double lift = 0.05 * (base::two_pi / 2.0) * (base::two_pi / 2.0) * base::cos(angle);
        worst =
            std::max(worst, std::abs(found[0].normal_impulse - 0.1 * (gravity + lift) * tick_s));
    }
    EXPECT_LE(worst, 0.1 * 2.5e-6 * half / tick_s); // where such a gap closes within a tick
}

TEST(Kinematic, ATurntableCarriesACubeRoundAndThrowsItOffWhenItTurnsTooFast)
{
    constexpr double radius = 0.1;
    for (const double turn : {3.0, 8.0}) { // rad/s: 0.9 and 6.4 m/s^2 of 2.9
        Description scene = plate_with_cube();
        scene.bodies[0].position = {{radius, half, 0.0}};
        scene.bodies[0].velocity = {{0.0, 0.0, -turn * radius}};
        scene.bodies[0].angular_velocity = {0.0, turn, 0.0};
        scene.bodies[1].angular_velocity = {0.0, turn, 0.0};
        World world = world_of(scene);
        run(world, 500);
        const glm::dvec3 place = world.position(0).value;
        const double now = std::sqrt(place.x * place.x + place.z * place.z);
        if (turn > 5.0) {
            EXPECT_GT(now, 1.5 * radius);
            continue;
        }
        EXPECT_NEAR(now, radius, 1e-5);
        EXPECT_NEAR(place.x, radius * base::cos(turn * 0.5), 1e-4);
        EXPECT_NEAR(place.z, -radius * base::sin(turn * 0.5), 1e-4);
        EXPECT_NEAR(world.body(0).angular_velocity.y, turn, 1e-6);
    }
}

TEST(Kinematic, AHandFeelsItByDepthAndClosingSpeed)
{
    Description scene = plate_with_cube();
    scene.bodies.erase(scene.bodies.begin());
    scene.bodies[0].velocity = {{0.0, 0.1, 0.0}};
    scene.hands.count = 1;
    World world = world_of(scene);
    ASSERT_FALSE(world.set_hand(0, {.position = {{0.0, 0.004, 0.0}}, .velocity = {}}));
    for (int i = 0; i < 5; ++i) world.tick();
    // 1 mm deep at the start, 0.1 mm more with every tick: the mean over the fifth.
    const double depth = 1e-3 + 4.5 * 1e-4;
    EXPECT_NEAR(world.touch(0).on_hand.y(), 500.0 * depth + 2.0 * 0.1, 1e-12);
    EXPECT_FALSE(world.touch(0).touching); // no movable body
}

TEST(Kinematic, AMoveComesToItsTargetAndGoesOnFromThere)
{
    Description scene = plate_with_cube();
    scene.bodies[0].position = {{0.0, 5.0, 0.0}};
    World world = world_of(scene);
    BodyState target = world.body(1);
    target.position = {{0.003, 0.001, 0.0}};
    target.orientation = {base::cos(0.6), 0.0, 0.0, base::sin(0.6)};
    target.velocity = {{1.0, 0.0, 0.0}};
    target.angular_velocity = {0.0, 0.0, 2.0};
    ASSERT_FALSE(world.move(1, target));
    world.tick();
    EXPECT_EQ(world.position(1), target.position);
    EXPECT_EQ(world.body(1).orientation, base::normalized(target.orientation));
    EXPECT_EQ(world.velocity(1), target.velocity);
    EXPECT_EQ(world.body(1).angular_velocity, target.angular_velocity);
    run(world, 100);
    EXPECT_NEAR(world.position(1).x(), 0.103, 1e-14);
    EXPECT_NEAR(world.body(1).orientation.z, base::sin(0.6 + 0.1), 1e-14);
    ASSERT_FALSE(world.drive(1, {{0.0, 0.0, 0.5}}, {}));
    run(world, 100);
    EXPECT_NEAR(world.position(1).x(), 0.103, 1e-14);
    EXPECT_NEAR(world.position(1).z(), 0.05, 1e-14);
}

TEST(Kinematic, TheWayToATargetIsWhatIsFelt)
{
    // A turn within one tick: a hand at the rim of a disc is pushed by the mean speed there.
    Description scene = plate_with_cube();
    scene.bodies.erase(scene.bodies.begin());
    scene.hands.count = 1;
    World world = world_of(scene);
    ASSERT_FALSE(world.set_hand(0, {.position = {{0.5, 0.004, 0.0}}, .velocity = {}}));
    constexpr double angle = 1e-4;
    BodyState target = world.body(0);
    target.orientation = {base::cos(0.5 * angle), 0.0, 0.0, base::sin(0.5 * angle)};
    ASSERT_FALSE(world.move(0, target));
    world.tick();
    const double rise = 0.5 * angle; // of the surface there
    EXPECT_NEAR(world.touch(0).on_hand.y(), 500.0 * (1e-3 + 0.5 * rise) + 2.0 * rise / tick_s,
                1e-4);
}

TEST(Kinematic, ASleeperWakesWhenItsPlateStartsAndIsCarriedHoweverSlowly)
{
    Description scene = plate_with_cube();
    scene.bodies.push_back(cube_at({0.5, half, 0.0}));
    World world = World::freeze(scene).value();
    EXPECT_EQ(world.stepper_kind(), StepperKind::few);
    run(world, 300);
    ASSERT_FALSE(world.is_awake(0) || world.is_awake(2));
    constexpr double slow = 2e-4; // below the speed limit of rest
    ASSERT_FALSE(world.drive(1, {{slow, 0.0, 0.0}}, {}));
    run(world, 2000);
    EXPECT_TRUE(world.is_awake(0));
    const double gone = 2.0 * slow - 0.5 * slow * slow / slip_limit;
    EXPECT_NEAR(world.position(0).x(), gone, 1e-12);
    EXPECT_NEAR(world.position(2).x() - 0.5, gone, 1e-12);
    ASSERT_FALSE(world.drive(1, {}, {}));
    run(world, 300);
    EXPECT_FALSE(world.is_awake(0) || world.is_awake(2));
}

TEST(Kinematic, OneThatComesFromAfarWakesWhatItHits)
{
    Description scene = platform();
    scene.bodies = {cube_at({0.0, half, 0.0}), cube_at({0.0, 3.0 * half, 0.0})};
    BodyDescription ram{.name = "ram", .movable = false, .kinematic = true};
    ram.half = glm::dvec3{half};
    ram.position = {{-0.5, 1.01 * half, 0.0}};
    scene.bodies.push_back(ram);
    World world = World::freeze(scene).value();
    run(world, 300);
    ASSERT_FALSE(world.is_awake(0));
    ASSERT_FALSE(world.drive(2, {{1.0, 0.0, 0.0}}, {}));
    run(world, 600);
    EXPECT_GT(world.position(0).x(), 0.1);
    EXPECT_GE(world.position(0).x() - world.position(2).x(), 2.0 * half - 1e-4);
}

/// A heap of cubes and two hands on a floor that moves with a velocity, all of them with it.
World heap_on_a_moving_floor(double speed)
{
    Description scene = plate_with_cube();
    scene.bodies[1].half = {20.0, 0.01, 20.0};
    scene.bodies.insert(scene.bodies.begin() + 1, cube_at({0.011, 3.1 * half, 0.003}));
    scene.bodies.insert(scene.bodies.begin() + 1, cube_at({-0.05, 1.5 * half, 0.01}));
    scene.bodies.insert(scene.bodies.begin() + 1, cube_at({-0.03, 5.0 * half, 0.0}));
    for (BodyDescription& body : scene.bodies) body.velocity = {{speed, 0.0, -0.5 * speed}};
    scene.bodies[0].angular_velocity = {1.0, 2.0, 3.0};
    return world_of(scene);
}

/// The work of a plate and of torques is no gain of energy from nothing, and is not removed.
TEST(Kinematic, NoEnergyThatItGivesIsHeldBack)
{
    for (const double restitution : {0.0, 0.8}) {
        for (const double weight : {0.0, gravity}) {
            Description scene = plate_with_cube();
            scene.gravity = {0.0, -weight, 0.0};
            scene.bodies[0].material.restitution = restitution;
            scene.bodies.push_back(cube_at({0.2, half, 0.0}, 1.0));
            scene.bodies.push_back(cube_at({0.2, 3.0 * half, 0.0}, 0.1));
            scene.bodies[1].sway = {{0.05, 0.02, 0.01}, 300ms};
            World world = world_of(scene);
            for (int i = 0; i < 2000; ++i) {
                if (i % 100 < 50) {
                    ASSERT_FALSE(world.push_torque(0, {0.0, 0.02, 0.0}));
                }
                world.tick();
            }
            const Interventions& counted = world.state().interventions;
            EXPECT_EQ(counted.islands_limited, 0U) << restitution << ' ' << weight;
            EXPECT_EQ(counted.impulses_trimmed, 0U) << restitution << ' ' << weight;
        }
    }
}

TEST(Kinematic, NoEnergyOfATurntableIsHeldBack)
{
    Description scene = plate_with_cube();
    scene.bodies[0].position = {{0.3, half, 0.0}};
    scene.bodies.push_back(cube_at({0.3, 3.0 * half, 0.0}, 1.0));
    scene.bodies[1].angular_velocity = {0.0, 9.0, 0.0};
    World world = world_of(scene);
    run(world, 3000); // they are thrown off
    EXPECT_EQ(world.state().interventions.islands_limited, 0U);
    EXPECT_EQ(world.state().interventions.impulses_trimmed, 0U);
}

/// A thin plate 0.5 m before three cubes that rest one behind the other on smooth ground.
Description plate_before_cubes()
{
    Description scene;
    scene.hands.count = 0;
    scene.planes.push_back({.name = "ground", .offset_m = -half});
    for (int i = 0; i < 3; ++i) scene.bodies.push_back(cube_at({0.1 * i, 0.0, 0.0}));
    BodyDescription plate{.name = "plate", .movable = false, .kinematic = true};
    plate.half = {0.001, 0.1, 0.1};
    plate.position = {{-0.5, 0.0, 0.0}};
    scene.bodies.push_back(plate);
    return scene;
}

TEST(Kinematic, AFastPlatePassesNoSleeper)
{
    for (const double speed : {5.0, 30.0, 100.0, 900.0}) {
        World world = World::freeze(plate_before_cubes(), {.tick = 1ms, .sleeping = true}).value();
        run(world, 2000);
        for (BodyId id = 0; id < 3; ++id) ASSERT_FALSE(world.is_awake(id));
        ASSERT_FALSE(world.drive(3, {{speed, 0.0, 0.0}}, {}));
        const int ticks = 10 + static_cast<int>(1.0 / (speed * tick_s));
        for (int i = 0; i < ticks; ++i) {
            world.tick();
            for (BodyId id = 0; id < 3; ++id)
                ASSERT_GE(world.position(id).x(), world.position(3).x()) << speed << ' ' << i;
        }
        for (BodyId id = 0; id < 3; ++id) EXPECT_GE(world.velocity(id).x(), 0.99 * speed) << speed;
    }
}

TEST(Kinematic, APlateThatIsPutFarOnTakesAlongWhatIsInItsWay)
{
    for (const double end : {0.0, 50.0}) {
        World world = World::freeze(plate_before_cubes(), {.tick = 1ms, .sleeping = true}).value();
        run(world, 2000);
        ASSERT_FALSE(world.move(3, {.position = {{0.3, 0.0, 0.0}}, .velocity = {{end, 0.0, 0.0}}}));
        for (int i = 0; i < 10; ++i) {
            world.tick();
            for (BodyId id = 0; id < 3; ++id)
                ASSERT_GE(world.position(id).x(), world.position(3).x()) << end << ' ' << i;
        }
    }
}

TEST(Kinematic, WhatHappensOnAMovingFloorHappensOnOneThatRests)
{
    constexpr double speed = 0.75;
    World moving = heap_on_a_moving_floor(speed);
    World resting = heap_on_a_moving_floor(0.0);
    double worst = 0.0;
    for (int i = 1; i <= 400; ++i) {
        moving.tick();
        resting.tick();
        const glm::dvec3 gone = i * tick_s * speed * glm::dvec3{1.0, 0.0, -0.5};
        for (BodyId id = 0; id < 5; ++id) {
            worst = std::max(worst,
                             length(moving.position(id).value - gone - resting.position(id).value));
        }
    }
    EXPECT_LE(worst, 1e-6);
    EXPECT_GT(length(resting.velocity(0).value) + length(resting.position(3).value), 0.0);
}

TEST(Kinematic, OnlyItIsDrivenAndOnlyWithinTheRanges)
{
    World world = world_of(plate_with_cube());
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(world.drive(0, {}, {}), Refusal::no_such_body);
    EXPECT_EQ(world.move(2, {}), Refusal::no_such_body);
    EXPECT_EQ(world.push(1, {}), Refusal::no_such_body);
    EXPECT_EQ(world.place(1, {}), Refusal::no_such_body);
    EXPECT_EQ(world.drive(1, {{nan, 0.0, 0.0}}, {}), Refusal::not_finite);
    EXPECT_EQ(world.drive(1, {{1e5, 0.0, 0.0}}, {}), Refusal::out_of_range);
    EXPECT_EQ(world.drive(1, {}, {0.0, 1e9, 0.0}), Refusal::out_of_range);              // rad/s
    EXPECT_EQ(world.move(1, {.position = {{100.0, 0.0, 0.0}}}), Refusal::out_of_range); // 1e5 m/s
    EXPECT_EQ(world.move(1, {.orientation = {2.0, 0.0, 0.0, 0.0}}), Refusal::out_of_range);
    const auto before = world.hash();
    world.tick();
    EXPECT_EQ(world.position(1).y(), -0.01);
    EXPECT_NE(world.hash(), before);
}

TEST(Kinematic, ADescriptionSaysWhatItCannotBe)
{
    Description scene = plate_with_cube();
    scene.bodies[1].movable = true;
    EXPECT_EQ(check(scene).error().message, "body 2 'plate': a kinematic body is not movable");
    scene = plate_with_cube();
    scene.bodies[1].sway.by.x = 0.1;
    EXPECT_EQ(check(scene).error().message, "body 2 'plate': sway needs a sway_period");
    scene.bodies[1].sway.period = 1s;
    EXPECT_TRUE(check(scene));
    scene.bodies[1].velocity.value.x = 1.0;
    EXPECT_FALSE(check(scene));
    Description fixed = plate_with_cube();
    fixed.bodies[1].kinematic = false;
    EXPECT_NE(hash(fixed), hash(plate_with_cube()));
}

TEST(Kinematic, TheConveyorTakesItsCubesAlongAndTheTurntableTurnsOne)
{
    const Description scene = test::bench_scene("conveyor");
    World world = World::freeze(scene).value();
    run(world, 1000);
    for (BodyId cube = 4; cube < 10; ++cube) {
        const double gone = world.position(cube).x() - scene.bodies[cube].position.x();
        EXPECT_NEAR(gone, 0.1 - 0.5 * 0.01 / (0.5 * gravity), 1e-9) << cube;
    }
    EXPECT_NEAR(world.body(3).angular_velocity.y, 1.0, 1e-6);
    run(world, 4000);
    const glm::dvec3 from_axis = world.position(3).value - world.position(1).value;
    EXPECT_NEAR(std::sqrt(from_axis.x * from_axis.x + from_axis.z * from_axis.z), 0.15, 1e-3);
    EXPECT_NE(world.position(9).z(), 0.0); // the gate was in its way
}

TEST(Kinematic, ASnapshotBringsBackItsScript)
{
    Description scene = plate_with_cube();
    scene.bodies[1].sway = {{0.1, 0.0, 0.0}, 700ms};
    World world = world_of(scene);
    run(world, 123);
    BodyState target = world.body(1);
    target.position.value.y += 1e-3;
    ASSERT_FALSE(world.move(1, target));
    const World::Snapshot snapshot = world.snapshot();
    run(world, 50);
    const auto future = world.hash();
    world.restore(snapshot);
    run(world, 50);
    EXPECT_EQ(world.hash(), future);
}

} // namespace
} // namespace hapnet::scene::kinematic_test
