// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Spheres and capsules in descriptions, under hands, and in queries.
#include "proto/base/math.hpp"
#include "scene/query.hpp"
#include "scene/requirements.hpp"
#include "scene/text/text.hpp"
#include "tests/unit/scene/rigid/scenes.hpp"

#include <array>
#include <gtest/gtest.h>

namespace hapnet::scene::world_round_test {
namespace {

BodyDescription ball_at(const glm::dvec3& place)
{
    BodyDescription ball{.name = "ball", .shape = Shape::sphere, .position = {place}};
    ball.half = glm::dvec3{half};
    return ball;
}

/// A capsule along z.
BodyDescription capsule_at(const glm::dvec3& place)
{
    BodyDescription capsule{.name = "capsule", .shape = Shape::capsule, .position = {place}};
    capsule.half = {0.01, 0.01, 0.04};
    return capsule;
}

TEST(RoundBodies, HaveTheInertiaOfTheFormulas)
{
    BodyDescription body = ball_at({0.0, 0.0, 0.0});
    EXPECT_NEAR(inertia_of(body).x, 0.4 * 0.1 * half * half, 1e-20);
    EXPECT_EQ(inertia_of(body).x, inertia_of(body).z);
    EXPECT_NEAR(mass_of(body, 1000.0), 1000.0 * 2.0 / 3.0 * base::two_pi * half * half * half,
                1e-15);
    // For a capsule the moment is a sum over thin slices across it.
    body = capsule_at({0.0, 0.0, 0.0});
    constexpr int slices = 200'000;
    double volume = 0.0, along = 0.0, across = 0.0;
    for (int i = 0; i < slices; ++i) {
        const double z = 0.04 * ((i + 0.5) / slices * 2.0 - 1.0);
        const double beyond = std::max(std::abs(z) - 0.03, 0.0);
        const double square = 0.01 * 0.01 - beyond * beyond;
        volume += square;
        along += 0.5 * square * square;
        across += square * (0.25 * square + z * z);
    }
    const glm::dvec3 inertia = inertia_of(body);
    EXPECT_NEAR(inertia.z, 0.1 * along / volume, 1e-8 * inertia.z);
    EXPECT_NEAR(inertia.x, 0.1 * across / volume, 1e-8 * inertia.x);
    EXPECT_EQ(inertia.x, inertia.y);
    EXPECT_NEAR(mass_of(body, 1.0), 0.5 * base::two_pi * volume * 0.08 / slices, 1e-12);
}

TEST(RoundBodies, HaveEqualEdgesAcross)
{
    Description scene = platform();
    scene.bodies = {ball_at({0.0, 1.0, 0.0})};
    scene.bodies[0].half.y = 0.03;
    EXPECT_FALSE(check(scene));
    scene.bodies = {capsule_at({0.0, 1.0, 0.0})};
    EXPECT_TRUE(check(scene));
    scene.bodies[0].half.y = 0.02;
    EXPECT_FALSE(check(scene));
    scene.bodies[0].half = glm::dvec3{0.02};
    EXPECT_FALSE(check(scene));
}

TEST(RoundBodies, CountInTheHashAndAreANeed)
{
    Description scene = platform();
    scene.bodies = {cube_at({0.0, half, 0.0})};
    scene.bodies[0].turning = Turning::locked;
    const std::uint64_t before = hash(scene);
    EXPECT_FALSE(required_features(requirements_of(scene, true)).has(Feature::shapes));
    scene.bodies[0].shape = Shape::sphere;
    EXPECT_NE(hash(scene), before);
    const FeatureSet needed = required_features(requirements_of(scene, true));
    EXPECT_TRUE(needed.has(Feature::shapes));
    EXPECT_EQ(cheapest_stepper(needed), StepperKind::lone);
}

TEST(RoundBodies, AreWrittenAsAShapeAndTheEdgesOfTheBoxAround)
{
    const auto scene = parse_scene(R"(
[[body]]
shape = "sphere"
size = "40mm"
density = "1000kg/m3"
[[body]]
shape = "capsule"
size = ["20mm", "20mm", "80mm"]
mass = "100g"
)",
                                   "test");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->bodies[0].shape, Shape::sphere);
    EXPECT_EQ(scene->bodies[0].mass_kg, mass_of(scene->bodies[0], 1000.0));
    EXPECT_EQ(scene->bodies[1].shape, Shape::capsule);
    EXPECT_EQ(parse_scene(to_text(*scene), "printed").value(), *scene);
}

TEST(RoundBodies, AreFeltAsTheirNormalSays)
{
    for (const BodyDescription& round : {ball_at({0.0, 0.0, 0.0}), capsule_at({0.0, 0.0, 0.0})}) {
        Description scene;
        scene.gravity = glm::dvec3{0.0};
        scene.bodies = {round};
        scene.bodies[0].movable = false;
        scene.bodies.push_back(cube_at({1.0, 0.0, 0.0})); // something movable
        scene.hands = {.stiffness_n_per_m = 500.0, .damping_ns_per_m = 0.0, .count = 1};
        World world = world_of(scene);
        const glm::dvec3 direction = glm::normalize(glm::dvec3{0.6, 0.7, 0.0});
        const double radius = round.half.x + scene.hands.radius_m;
        const double aside = round.shape == Shape::capsule ? 0.02 : 0.0; // along the capsule
        const HandInput hand{.position = {(radius - 0.001) * direction + glm::dvec3{0, 0, aside}}};
        ASSERT_FALSE(world.set_hand(0, hand));
        world.tick();
        EXPECT_LT(length(world.touch(0).on_hand.value - 0.5 * direction), 1e-12) << round.name;
        EXPECT_NEAR(world.touch(0).depth_m, 0.001, 1e-15);
    }
}

TEST(RoundBodies, BounceOffAHandWithTheSpeedThatTheyCameWith)
{
    for (const BodyDescription& round : {ball_at({0.0, 0.0, 0.0}), capsule_at({0.0, 0.0, 0.0})}) {
        Description scene;
        scene.gravity = glm::dvec3{0.0};
        scene.bodies = {round};
        const glm::dvec3 direction = glm::normalize(glm::dvec3{0.6, 0.7, 0.0});
        scene.bodies[0].velocity.value = 0.5 * direction;
        scene.hands = {.stiffness_n_per_m = 500.0,
                       .damping_ns_per_m = 0.0,
                       .force_max_n = std::numeric_limits<double>::infinity(),
                       .count = 1};
        World world = world_of(scene);
        const HandInput hand{.position = {0.05 * direction}};
        for (int i = 0; i < 300; ++i) {
            ASSERT_FALSE(world.set_hand(0, hand));
            world.tick();
        }
        const BodyState state = world.body(0);
        EXPECT_LT(length(state.velocity.value + 0.5 * direction), 1e-9) << round.name;
        EXPECT_LT(length(state.angular_velocity), 1e-9) << round.name;
    }
}

TEST(RoundBodies, GainNothingFromHandsThatPushThemAside)
{
    Description scene = platform();
    scene.bodies = {ball_at({0.0, half, 0.0})};
    scene.bodies[0].material.friction = friction;
    scene.hands.count = 2;
    scene.hands.damping_ns_per_m = 0.0;
    World world = world_of(scene);
    const double before = energy(world);
    // For resting hands, the work given equals the energy stored at their arrival.
    const double depth = 0.003;
    const double most = before + 2.0 * 0.5 * scene.hands.stiffness_n_per_m * depth * depth;
    const double away = half + scene.hands.radius_m - depth;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_FALSE(world.set_hand(0, {.position = {{-away, half, 0.001}}}));
        ASSERT_FALSE(world.set_hand(1, {.position = {{away, half, -0.001}}}));
        world.tick();
        ASSERT_LE(energy(world), most * (1.0 + 1e-6)) << i;
    }
}

TEST(RoundBodies, AnswerQuestions)
{
    Description scene = platform();
    scene.bodies = {ball_at({0.0, half, 0.0}), capsule_at({0.1, 0.01, 0.0})};
    World world = world_of(scene);
    run(world, 200);
    std::array<Contact, 8> room;
    ASSERT_EQ(contacts(world, room), 2U);
    EXPECT_NEAR(room[0].normal_impulse, 0.1 * gravity * 1e-3, 1e-9);
    EXPECT_LT(length(room[0].at.value), 1e-9);
    EXPECT_LT(length(room[1].at.value - glm::dvec3{0.1, 0.0, 0.0}), 1e-9); // of both ends
    const auto hit = cast_ray(world, {.origin = {{-1.0, half, 0.0}}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance_m, 1.0 - half, 1e-9);
    EXPECT_NEAR(separation(world, 0, 1).distance, std::hypot(0.1, 0.01) - 0.03, 1e-9);
    EXPECT_NEAR(separation(world, base::Position{{0.0, half, 0.1}}, 0).distance, 0.08, 1e-9);
    EXPECT_EQ(nearest_body(world, {{0.1, 0.05, 0.0}})->body, 1U);
    std::array<BodyId, 4> found{};
    EXPECT_EQ(bodies_in_sphere(world, {{0.0, 0.1, 0.0}}, 0.061, found), 1U);
    EXPECT_EQ(bodies_in_sphere(world, {{0.0, 0.1, 0.0}}, 0.059, found), 0U);
}

TEST(RoundBodies, FallAsleepAndWake)
{
    Description scene = platform();
    scene.bodies = {capsule_at({0.0, 0.01, 0.0}), capsule_at({0.0, 0.03, 0.0})};
    scene.bodies[1].position.value = {0.0, 0.2, 0.0};
    auto world = World::freeze(scene, {}).value();
    run(world, 150);
    EXPECT_FALSE(world.is_awake(0));
    run(world, 100); // the other body falls onto it
    EXPECT_NE(world.position(0).value, scene.bodies[0].position.value);
}

} // namespace
} // namespace hapnet::scene::world_round_test
