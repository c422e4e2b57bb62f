// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Forces at a point, torques and blows: against formulas.
#include "scene/maths/vector.hpp"
#include "scene/world.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::world_push_test {
namespace {

using namespace std::chrono_literals;

constexpr double tick_s = 1e-3;

/// A cube of 40 mm and 100 g, alone in space.
Description cube_in_space()
{
    Description scene;
    scene.gravity = glm::dvec3{0.0};
    scene.hands.count = 0;
    scene.bodies.resize(1);
    return scene;
}

/// Returns a scene with the cube, and a distant part that needs this stepper.
Description cube_for(StepperKind kind)
{
    Description scene = cube_in_space();
    if (kind != StepperKind::flight) scene.planes.push_back({.name = {}, .offset_m = -100.0});
    if (kind >= StepperKind::few) {
        scene.bodies.resize(2);
        scene.bodies[1].position = {{50.0, 0.0, 0.0}};
    }
    return scene;
}

double inertia_of_cube() { return box_inertia(0.1, glm::dvec3{0.02}).x; }

/// Returns the rotation of a body about z, radians, up to half a turn.
double angle_about_z(const World& world)
{
    const glm::dquat q = world.body(0).orientation;
    return 2.0 * std::atan2(q.z, q.w);
}

glm::dvec3 angular_momentum(const World& world, BodyId body = 0)
{
    const Bodies& bodies = world.state().bodies;
    return bodies.angular_momentum.at(bodies.slot_of[body]);
}

class EveryStepperThatTurns : public testing::TestWithParam<StepperKind> {};

TEST_P(EveryStepperThatTurns, ATorqueThatHoldsTurnsACubeByTheExactAngle)
{
    World world =
        World::freeze(cube_for(GetParam()), {.sleeping = true, .stepper = GetParam()}).value();
    constexpr double torque = 1e-4;
    constexpr int ticks = 1000;
    for (int i = 0; i < ticks; ++i) {
        ASSERT_FALSE(world.push_torque(0, {0.0, 0.0, torque}));
        world.tick();
    }
    const double acceleration = torque / inertia_of_cube();
    EXPECT_NEAR(angle_about_z(world), 0.5 * acceleration, 1e-12);
    EXPECT_NEAR(world.body(0).angular_velocity.z, acceleration, 1e-12);
    EXPECT_EQ(world.body(0).angular_velocity.x, 0.0);
    EXPECT_EQ(world.position(0), base::Position{});
}

TEST_P(EveryStepperThatTurns, AForceAtAPointGivesItsMomentumAndItsMoment)
{
    Description scene = cube_for(GetParam());
    scene.bodies[0].half = {0.03, 0.02, 0.01};
    scene.bodies[0].angular_velocity = {1.0, -2.0, 3.0};
    scene.bodies[0].velocity = {{0.1, 0.2, -0.3}};
    World world = World::freeze(scene, {.sleeping = true, .stepper = GetParam()}).value();
    const glm::dvec3 turning = angular_momentum(world);
    const glm::dvec3 force{0.2, -0.4, 0.1};
    glm::dvec3 moment{0.0};
    constexpr int ticks = 500;
    for (int i = 0; i < ticks; ++i) {
        const base::Position corner{world.position(0).value + glm::dvec3{0.01, 0.02, -0.03}};
        ASSERT_FALSE(world.push(0, {force}, corner));
        moment += tick_s * glm::cross(corner.value - world.position(0).value, force);
        world.tick();
    }
    const double time = ticks * tick_s;
    const glm::dvec3 velocity = scene.bodies[0].velocity.value + (time / 0.1) * force;
    EXPECT_LE(length(world.velocity(0).value - velocity), 1e-13);
    EXPECT_LE(
        length(world.position(0).value - 0.5 * time * (scene.bodies[0].velocity.value + velocity)),
        1e-13);
    EXPECT_LE(length(angular_momentum(world) - (turning + moment)), 1e-13 * length(moment));
}

TEST_P(EveryStepperThatTurns, ABlowActsAtOnceAndOnce)
{
    Description scene = cube_for(GetParam());
    scene.bodies[0].half = {0.03, 0.02, 0.01};
    World world = World::freeze(scene, {.sleeping = true, .stepper = GetParam()}).value();
    const glm::dvec3 impulse{0.02, 0.0, -0.01};
    const glm::dvec3 at{0.0, 0.02, 0.01};
    ASSERT_FALSE(world.apply_impulse(0, impulse, {at}));
    EXPECT_LE(length(world.velocity(0).value - 10.0 * impulse), 1e-16);
    EXPECT_EQ(angular_momentum(world), glm::cross(at, impulse));
    world.tick();
    EXPECT_LE(length(world.velocity(0).value - 10.0 * impulse), 1e-16);
    EXPECT_LE(length(world.position(0).value - 10.0 * tick_s * impulse), 1e-17);
    EXPECT_EQ(angular_momentum(world), glm::cross(at, impulse));
}

TEST_P(EveryStepperThatTurns, TorquesOfOneTickAddUpAndAreGoneInTheNext)
{
    World world =
        World::freeze(cube_for(GetParam()), {.sleeping = true, .stepper = GetParam()}).value();
    ASSERT_FALSE(world.push_torque(0, {0.0, 1e-3, 0.0}));
    ASSERT_FALSE(world.push_torque(0, {0.0, 1e-3, 0.0}));
    ASSERT_FALSE(world.push(0, {{1.0, 0.0, 0.0}}, {{0.0, 0.0, 0.002}})); // 2e-3 N m more
    world.tick();
    EXPECT_NEAR(angular_momentum(world).y, 4e-6, 1e-20);
    const auto before = angular_momentum(world);
    world.tick();
    EXPECT_EQ(angular_momentum(world), before);
}

INSTANTIATE_TEST_SUITE_P(Push, EveryStepperThatTurns,
                         testing::Values(StepperKind::flight, StepperKind::lone, StepperKind::few,
                                         StepperKind::many),
                         [](const auto& each) { return std::string{name_of(each.param)}; });

TEST(Push, TheAngleUnderATorqueDoesNotDependOnTheTick)
{
    for (const base::Duration tick : {base::Duration{4ms}, base::Duration{250us}}) {
        World world = World::freeze(cube_for(StepperKind::lone), {.tick = tick}).value();
        const int ticks = static_cast<int>(std::lround(0.5 / base::to_seconds(tick)));
        for (int i = 0; i < ticks; ++i) {
            ASSERT_FALSE(world.push_torque(0, {0.0, 0.0, 1e-4}));
            world.tick();
        }
        EXPECT_NEAR(angle_about_z(world), 0.125 * 1e-4 / inertia_of_cube(), 1e-12);
    }
}

TEST(Push, ATorqueTurnsACubeExactlyWhileAHandPressesItsMiddle)
{
    Description scene = cube_in_space();
    scene.hands.count = 1;
    World world = World::freeze(scene).value();
    constexpr double torque = 1e-5;
    constexpr int ticks = 100;
    for (int i = 0; i < ticks; ++i) {
        // About the hand's normal its spring has no moment.
        const double behind = world.position(0).z() - 0.0245;
        ASSERT_FALSE(world.set_hand(0, {.position = {{0.0, 0.0, behind}}, .velocity = {}}));
        ASSERT_FALSE(world.push_torque(0, {0.0, 0.0, torque}));
        world.tick();
        ASSERT_TRUE(world.touch(0).touching);
    }
    const double time = ticks * tick_s;
    EXPECT_NEAR(angle_about_z(world), 0.5 * torque / inertia_of_cube() * time * time, 1e-13);
    EXPECT_NEAR(angular_momentum(world).z, torque * time, 1e-18);
}

TEST(Push, ALockedAxisTakesNothing)
{
    Description scene = cube_in_space();
    scene.bodies[0].locked.y = true;
    scene.bodies[0].turning = Turning::about_y;
    World world = World::freeze(scene).value();
    ASSERT_FALSE(world.push_torque(0, {1e-3, 1e-3, 1e-3}));
    ASSERT_FALSE(world.push(0, {{1.0, 1.0, 1.0}}, {{0.01, 0.0, 0.0}}));
    ASSERT_FALSE(world.apply_impulse(0, {0.01, 0.01, 0.01}, {{0.0, 0.0, 0.01}}));
    world.tick();
    EXPECT_EQ(world.position(0).y(), 0.0);
    EXPECT_EQ(world.velocity(0).y(), 0.0);
    EXPECT_GT(world.velocity(0).x(), 0.0);
    EXPECT_EQ(angular_momentum(world).x, 0.0);
    EXPECT_EQ(angular_momentum(world).z, 0.0);
    EXPECT_NEAR(angular_momentum(world).y, 1e-6 - 1e-5 + 1e-4, 1e-19);
}

TEST(Push, ABoxThatCannotTurnIsPushedAsIfAtItsCentre)
{
    World world = World::freeze(paper_scene()).value();
    World other = world;
    ASSERT_EQ(world.stepper_kind(), StepperKind::sliding);
    for (int i = 0; i < 100; ++i) {
        ASSERT_FALSE(world.push(0, {{0.5, 0.0, 0.1}}, {{0.0, 0.02, 0.02}}));
        ASSERT_FALSE(world.push_torque(0, {1.0, 2.0, 3.0}));
        ASSERT_FALSE(other.push(0, {{0.5, 0.0, 0.1}}));
        world.tick();
        other.tick();
    }
    EXPECT_EQ(world.hash(), other.hash());
    EXPECT_GT(world.velocity(0).x(), 0.0);
    ASSERT_FALSE(world.apply_impulse(0, {0.01, 0.0, 0.0}, {{0.0, 0.02, 0.0}}));
    EXPECT_NEAR(world.velocity(0).x() - other.velocity(0).x(), 0.1, 1e-15);
    EXPECT_EQ(world.body(0).angular_velocity, glm::dvec3{0.0});
}

/// Two cubes that sleep on a platform, one on the other.
World sleepers()
{
    Description scene = paper_scene();
    scene.bodies.resize(2);
    for (BodyDescription& body : scene.bodies) body.movable = true;
    for (BodyDescription& body : scene.bodies) body.turning = Turning::free;
    scene.bodies[1].position = {{0.0, 0.04, 0.0}};
    scene.planes[0].material.friction = 0.3;
    for (BodyDescription& body : scene.bodies) body.material.friction = 0.3;
    World world = World::freeze(scene).value();
    for (int i = 0; i < 300; ++i) world.tick();
    return world;
}

TEST(Push, ATorqueAndABlowWakeWhatSleepsAndItStillCarriesWhatIsOnIt)
{
    for (const bool is_blow : {false, true}) {
        World world = sleepers();
        ASSERT_FALSE(world.is_awake(0) || world.is_awake(1));
        const double height = world.position(1).y();
        if (is_blow) {
            ASSERT_FALSE(world.apply_impulse(0, {0.05, 0.0, 0.0}, world.position(0)));
            EXPECT_TRUE(world.is_awake(0));
        } else {
            ASSERT_FALSE(world.push_torque(0, {0.0, 0.02, 0.0}));
        }
        world.tick();
        EXPECT_TRUE(world.is_awake(0));
        EXPECT_NEAR(world.position(1).y(), height, 1e-12);
        EXPECT_GT(length(world.velocity(0).value) + length(angular_momentum(world)), 0.0);
    }
}

TEST(Push, TheGreatestTorquesAndForcesOnTheSmallestBodyLeaveEverythingFinite)
{
    Description scene = paper_scene();
    scene.bodies[0].turning = Turning::free;
    scene.bodies[0].half = {size_min_m, 2.0 * size_min_m, 3.0 * size_min_m};
    scene.bodies[0].mass_kg = mass_min_kg;
    scene.bodies[0].position = {{0.0, -0.0199, 0.0}};
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies.back().position = {{0.0, -0.0195, 0.0}};
    World world = World::freeze(scene).value();
    for (int i = 0; i < 100; ++i) {
        const double sign = i % 3 == 0 ? -1.0 : 1.0;
        ASSERT_FALSE(world.push_torque(0, sign * glm::dvec3{9e5, -1e6, 1e5}));
        ASSERT_FALSE(world.push(0, {{0.0, sign * 1e4, 0.0}}));
        world.tick();
        for (const BodyId body : {0U, 2U}) {
            const BodyState state = world.body(body);
            ASSERT_TRUE(base::is_finite(state.position) && base::is_finite(state.velocity)) << i;
            ASSERT_TRUE(base::is_finite(state.angular_velocity)) << i;
            ASSERT_NEAR(glm::dot(state.orientation, state.orientation), 1.0, 1e-12) << i;
        }
    }
}

TEST(Push, RefusesWhatIsNotFiniteOutOfRangeOrOfNoBodyAndStaysAsItWas)
{
    World world = World::freeze(cube_in_space()).value();
    const auto before = world.hash();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, 1e30}) {
        const Refusal why = bad == 1e30 ? Refusal::out_of_range : Refusal::not_finite;
        const glm::dvec3 wrong{0.0, bad, 0.0};
        EXPECT_EQ(world.push(0, {wrong}, {}), why);
        EXPECT_EQ(world.push(0, {}, {wrong}), why);
        EXPECT_EQ(world.push_torque(0, wrong), why);
        EXPECT_EQ(world.apply_impulse(0, wrong, {}), why);
        EXPECT_EQ(world.apply_impulse(0, {}, {wrong}), why);
    }
    EXPECT_EQ(world.push(1, {}, {}), Refusal::no_such_body);
    EXPECT_EQ(world.push_torque(1, {}), Refusal::no_such_body);
    EXPECT_EQ(world.apply_impulse(1, {}, {}), Refusal::no_such_body);
    // Beyond the limit of motion: no force is applied either.
    EXPECT_EQ(world.push(0, {{1e5, 0.0, 0.0}}, {{0.0, 100.0, 0.0}}), Refusal::out_of_range);
    EXPECT_EQ(world.apply_impulse(0, {1e4, 0.0, 0.0}, {}), Refusal::out_of_range); // 1e5 m/s
    // 9e3 m/s, but some 1e10 rad/s.
    EXPECT_EQ(world.apply_impulse(0, {900.0, 0.0, 0.0}, {{0.0, 1e3, 0.0}}), Refusal::out_of_range);
    world.tick();
    World untouched = World::freeze(cube_in_space()).value();
    untouched.tick();
    EXPECT_EQ(world.hash(), untouched.hash());
    EXPECT_NE(world.hash(), before); // the tick counts
}

} // namespace
} // namespace hapnet::scene::world_push_test
