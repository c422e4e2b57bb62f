// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Bodies and hands with a stiffness and a damping of their own.
#include "proto/base/math.hpp"
#include "scene/text/text.hpp"
#include "tests/support/scene/bench_scenes.hpp"
#include "tests/unit/scene/rigid/scenes.hpp"

#include <array>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::feel_test {
namespace {

constexpr double tick_s = 1e-3;

HandInput hand_at(const glm::dvec3& place) { return {.position = {place}, .velocity = {}}; }

/// Two cubes in space, one of them with a feel of its own, and two hands.
Description two_cubes()
{
    Description scene;
    scene.gravity = glm::dvec3{0.0};
    scene.hands.damping_ns_per_m = 0.0;
    scene.hands.force_max_n = std::numeric_limits<double>::infinity();
    scene.bodies = {cube_at({0.0, 0.0, 0.0}), cube_at({1.0, 0.0, 0.0})};
    scene.bodies[1].feel = {2000.0, std::nullopt};
    return scene;
}

/// Returns the velocity of a cube after a resting hand, at this depth in it, has thrown it off.
double thrown(double stiffness, double depth) { return depth * std::sqrt(stiffness / 0.1); }

TEST(Feel, ABodyThrowsByItsOwnStiffnessAndTheOthersByThatOfAllHands)
{
    World world = World::freeze(two_cubes()).value();
    EXPECT_EQ(world.stepper_kind(), StepperKind::few);
    ASSERT_FALSE(world.set_hand(0, hand_at({-half - 0.004, 0.0, 0.0})));
    ASSERT_FALSE(world.set_hand(1, hand_at({1.0 - half - 0.004, 0.0, 0.0})));
    run(world, 1);
    EXPECT_NEAR(world.touch(0).on_hand_at_start.x(), -500.0 * 1e-3, 1e-12);
    EXPECT_NEAR(world.touch(1).on_hand_at_start.x(), -2000.0 * 1e-3, 1e-12);
    run(world, 200);
    EXPECT_NEAR(world.velocity(0).x(), thrown(500.0, 1e-3), 1e-12);
    EXPECT_NEAR(world.velocity(1).x(), thrown(2000.0, 1e-3), 1e-12);
}

TEST(Feel, TheBodysOwnCountsBeforeTheHandsOwnAndThatBeforeAllHands)
{
    Description scene = two_cubes();
    scene.own_hands = {{1000.0, 3.0}};
    scene.bodies[1].feel.damping_ns_per_m = 7.0;
    const HandFeels feels{scene};
    const auto pair = [&](std::uint32_t hand, BodyId body) {
        const HandDescription& of = feels.of(hand, body, scene.hands);
        return std::pair{of.stiffness_n_per_m, of.damping_ns_per_m};
    };
    EXPECT_EQ(pair(0, 0), (std::pair{1000.0, 3.0}));
    EXPECT_EQ(pair(1, 0), (std::pair{500.0, 0.0}));
    EXPECT_EQ(pair(0, 1), (std::pair{2000.0, 7.0}));
    EXPECT_EQ(pair(1, 1), (std::pair{2000.0, 7.0}));
    EXPECT_EQ(feels.of(0, 0, scene.hands).radius_m, scene.hands.radius_m);
}

/// Two unlike hands on both sides of a cube, which oscillates between them.
Description between_unlike_hands(double damping_0, double damping_1)
{
    Description scene = two_cubes();
    scene.bodies.resize(1);
    scene.own_hands = {{400.0, damping_0}, {600.0, damping_1}};
    return scene;
}

TEST(Feel, TwoUnlikeSpringsOnOneBodyAreAnOscillatorOfBoth)
{
    World world = world_of(between_unlike_hands(0.0, 0.0));
    EXPECT_EQ(world.stepper_kind(), StepperKind::lone);
    const double place = half + 0.002; // both 3 mm deep
    ASSERT_FALSE(world.set_hand(0, hand_at({-place, 0.0, 0.0})));
    ASSERT_FALSE(world.set_hand(1, hand_at({place, 0.0, 0.0})));
    // 400 (3 mm - x) = 600 (3 mm + x) at x = -0.6 mm, which is the amplitude.
    const double frequency = std::sqrt(1000.0 / 0.1);
    double worst = 0.0;
    for (int i = 1; i <= 500; ++i) {
        world.tick();
        const double x = -0.6e-3 * (1.0 - base::cos(frequency * i * tick_s));
        worst = std::max(worst, std::abs(world.position(0).x() - x));
    }
    EXPECT_LE(worst, 1e-12);
}

TEST(Feel, SpringsOfUnlikeDampingOverStiffnessComeToRestWhereTheyAreInBalance)
{
    World world = world_of(between_unlike_hands(1.0, 0.5));
    const double place = half + 0.002;
    ASSERT_FALSE(world.set_hand(0, hand_at({-place, 0.0, 0.0})));
    ASSERT_FALSE(world.set_hand(1, hand_at({place, 0.0, 0.0})));
    // x'' = -1000/m (x - c) - 1.5/m x', from rest: damped, in closed form.
    const double c = -0.6e-3;
    const double decay = 0.5 * 1.5 / 0.1;
    const double frequency = std::sqrt(1000.0 / 0.1 - decay * decay);
    double worst = 0.0;
    for (int i = 1; i <= 1000; ++i) {
        world.tick();
        const double t = i * tick_s;
        const double swing =
            base::cos(frequency * t) + decay / frequency * base::sin(frequency * t);
        const double x = c * (1.0 - base::exp(-decay * t) * swing);
        worst = std::max(worst, std::abs(world.position(0).x() - x));
    }
    EXPECT_LE(worst, 1e-4 * std::abs(c)); // measured: 7.5e-5
    run(world, 3000);
    EXPECT_NEAR(world.position(0).x(), c, 1e-12);
}

TEST(Feel, AFixedBodyAndAGripHaveTheirs)
{
    Description scene = two_cubes();
    scene.bodies[0].movable = false;
    scene.bodies[0].feel = {5000.0, 4.0};
    scene.hands.grip_reach_m = 0.01;
    World world = World::freeze(scene).value();
    ASSERT_FALSE(
        world.set_hand(0, {.position = {{-half - 0.004, 0.0, 0.0}}, .velocity = {{0.1, 0, 0}}}));
    HandInput grip = hand_at({1.0 - half - 0.004, 0.0, 0.0});
    grip.gripping = true;
    ASSERT_FALSE(world.set_hand(1, grip));
    world.tick();
    EXPECT_NEAR(world.touch(0).on_hand.x(), -(5000.0 * (1e-3 + 0.05e-3) + 4.0 * 0.1), 1e-9);
    grip.position.value.x -= 1e-3;
    ASSERT_FALSE(world.set_hand(1, grip));
    world.tick();
    EXPECT_NEAR(world.touch(1).on_hand_at_start.x(), 2000.0 * 1e-3, 1e-9);
}

/// A platform that hands feel, with one hand.
Description felt_platform()
{
    Description scene;
    scene.hands.count = 1;
    scene.planes.push_back({.name = "felt", .normal = {0.0, 0.6, 0.8}, .felt = true});
    return scene;
}

TEST(FeltPlane, PushesAHandByItsDepthAndItsClosingSpeedUpToTheLimit)
{
    World world = World::freeze(felt_platform()).value();
    EXPECT_EQ(world.stepper_kind(), StepperKind::lone);
    const glm::dvec3 normal{0.0, 0.6, 0.8};
    const auto felt = [&](double height, double speed) {
        const HandInput hand{.position = {height * normal}, .velocity = {speed * normal}};
        EXPECT_FALSE(world.set_hand(0, hand));
        world.tick();
        const glm::dvec3 force = world.touch(0).on_hand.value;
        EXPECT_NEAR(length(force - glm::dot(force, normal) * normal), 0.0, 1e-12);
        return glm::dot(force, normal);
    };
    EXPECT_EQ(felt(0.006, 0.0), 0.0); // its radius is 5 mm
    EXPECT_NEAR(felt(0.003, 0.0), 500.0 * 0.002, 1e-12);
    EXPECT_NEAR(world.touch(0).depth_m, 0.002, 1e-15);
    EXPECT_NEAR(felt(0.003, -0.1), 500.0 * 0.00205 + 2.0 * 0.1, 1e-12); // the mean over the tick
    EXPECT_NEAR(world.touch(0).on_hand_at_start.y(), 0.6 * (1.0 + 0.2), 1e-12);
    EXPECT_EQ(felt(0.003, 2.0), 0.0); // faster away than the spring follows
    EXPECT_NEAR(felt(-0.1, 0.0), 3.3, 1e-12);
    // It touches half a tick after its start: 500 N/m over 0.1 mm, 2 N s/m over half the tick.
    EXPECT_NEAR(felt(0.0051, -0.2), 0.5 * (500.0 * 0.5 * 1e-4 + 2.0 * 0.2), 1e-12);
}

TEST(FeltPlane, IsFeltByAHandsOwnSpringAndBesideABody)
{
    Description scene = felt_platform();
    scene.planes[0].normal = {0.0, 1.0, 0.0};
    scene.own_hands = {{900.0, 0.0}};
    scene.bodies.push_back(cube_at({half + 0.004, half, 0.0}));
    scene.bodies[0].movable = false;
    scene.bodies.push_back(cube_at({5.0, half, 0.0})); // something that moves
    World world = World::freeze(scene).value();
    ASSERT_FALSE(world.set_hand(0, hand_at({0.0, 0.003, 0.0})));
    world.tick();
    EXPECT_NEAR(world.touch(0).on_hand.y(), 900.0 * 0.002, 1e-12);
    EXPECT_NEAR(world.touch(0).on_hand.x(), -900.0 * 0.001, 1e-12);
}

TEST(FeltPlane, OthersAreNotFeltAndCostNoFeature)
{
    Description scene = felt_platform();
    const auto felt_hash = hash(scene);
    scene.planes[0].felt = false;
    EXPECT_NE(hash(scene), felt_hash);
    EXPECT_FALSE(required_features(requirements_of(scene, true)).has(Feature::felt_planes));
    scene.bodies.push_back(cube_at({1.0, half, 0.0}));
    World world = World::freeze(scene).value();
    ASSERT_FALSE(world.set_hand(0, hand_at({0.0, -1.0, 0.0})));
    world.tick();
    EXPECT_EQ(world.touch(0).on_hand, base::Force{});
}

TEST(Feel, CostsAFeatureAndAHashOnlyWhereItIs)
{
    Description scene = two_cubes();
    scene.bodies[1].feel = {};
    const auto needs = [](const Description& one) {
        return required_features(requirements_of(one, true)).has(Feature::feel);
    };
    const auto before = hash(scene);
    EXPECT_FALSE(needs(scene));
    scene.own_hands.resize(1); // no values of its own
    EXPECT_FALSE(needs(scene));
    scene.own_hands[0].damping_ns_per_m = 0.0;
    EXPECT_TRUE(needs(scene));
    EXPECT_NE(hash(scene), before);
    scene.own_hands.resize(3);
    EXPECT_EQ(check(scene).error().message, "hands: [[hand]] 3 times for a count of 2");
    scene.own_hands.clear();
    scene.bodies[0].feel.stiffness_n_per_m = -1.0;
    EXPECT_FALSE(check(scene));
}

TEST(Feel, TheSceneOfSoftAndHardCubesIsFeltSo)
{
    const Description scene = test::bench_scene("soft-and-hard");
    EXPECT_EQ(parse_scene(to_text(scene), "again").value(), scene);
    World world = World::freeze(scene).value();
    const std::array<std::array<double, 3>, 2> stiffness{
        {{100.0, 500.0, 5000.0}, {100.0, 250.0, 5000.0}}};
    for (const std::uint32_t hand : {0U, 1U}) {
        for (const std::size_t cube : {0U, 1U, 2U}) {
            const double x = scene.bodies[cube].position.x() - half - 0.0049;
            ASSERT_FALSE(world.set_hand(hand, hand_at({x, 0.0, 0.0})));
            world.tick();
            EXPECT_NEAR(world.touch(hand).on_hand_at_start.x(), -1e-4 * stiffness[hand][cube],
                        1e-3);
            ASSERT_FALSE(world.set_hand(hand, {.position = {}, .velocity = {}, .present = false}));
            for (const BodyId body : {0U, 1U, 2U})
                ASSERT_FALSE(world.place(body, {.position = scene.bodies[body].position}));
        }
    }
}

} // namespace
} // namespace hapnet::scene::feel_test
