// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/query.hpp"

#include "scene/maths/vector.hpp"
#include "tests/support/allocations.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::query_test {
namespace {

using namespace std::chrono_literals;

constexpr double tick_s = 1e-3;
constexpr double weight = 0.1 * 9.81; // of a cube of 100 g, N

constexpr Thing body_of(BodyId id) { return {Thing::Kind::body, id}; }
constexpr Thing plane_of(std::uint32_t index) { return {Thing::Kind::plane, index}; }

World frozen(const Description& scene) { return World::freeze(scene).value(); }

void run(World& world, int ticks)
{
    for (int i = 0; i < ticks; ++i) world.tick();
}

/// Stacked cubes on the platform, which fall asleep.
Description tower(std::size_t cubes)
{
    Description scene = paper_scene();
    scene.planes[0].material.friction = 0.3;
    scene.bodies.clear();
    for (std::size_t i = 0; i < cubes; ++i) {
        BodyDescription cube;
        cube.position = {{0.0, 0.04 * static_cast<double>(i), 0.0}};
        cube.material.friction = 0.3;
        scene.bodies.push_back(cube);
    }
    return scene;
}

/// The paper's scene, but the cube may move along all axes: the plane supports it.
Description cube_on_plane()
{
    Description scene = paper_scene();
    scene.bodies[0].locked = {};
    return scene;
}

TEST(Contacts, WhatRestsIsPushedByItsWeightForATick)
{
    Description turning = cube_on_plane();
    turning.bodies[0].turning = Turning::free;
    Description rough = cube_on_plane();
    rough.planes[0].material.friction = rough.bodies[0].material.friction = 0.3;
    for (const Description& scene : {cube_on_plane(), rough, turning, tower(1)}) {
        World world = frozen(scene);
        run(world, 400);
        std::array<Contact, 4> found;
        ASSERT_EQ(contacts(world, found), 1U) << name_of(world.stepper_kind());
        EXPECT_EQ(found[0].body, 0U);
        EXPECT_EQ(found[0].other, plane_of(0));
        EXPECT_EQ(found[0].normal, (glm::dvec3{0.0, 1.0, 0.0}));
        EXPECT_NEAR(found[0].normal_impulse, weight * tick_s, 1e-15);
        EXPECT_NEAR(found[0].separation, 0.0, 1e-12);
        EXPECT_LE(length(found[0].at.value - glm::dvec3{0.0, -0.02, 0.0}), 1e-12);
    }
}

TEST(Contacts, AStackIsListedFromTheBottomAndAlsoWhileItSleeps)
{
    World world = frozen(tower(4));
    run(world, 1000);
    ASSERT_FALSE(world.is_awake(0));
    std::array<Contact, 8> found;
    ASSERT_EQ(contacts(world, found), 4U);
    const std::array<Thing, 4> others{body_of(1), plane_of(0), body_of(2), body_of(3)};
    const std::array<BodyId, 4> bodies{0, 0, 1, 2};
    const std::array<double, 4> carried{3.0, 4.0, 2.0, 1.0};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(found[i].body, bodies[i]);
        EXPECT_EQ(found[i].other, others[i]);
        EXPECT_NEAR(found[i].normal_impulse, carried[i] * weight * tick_s, 1e-9 * tick_s);
        EXPECT_NEAR(found[i].normal.y, i == 1 ? 1.0 : -1.0, 1e-12);
    }
    std::array<Contact, 8> own;
    ASSERT_EQ(contacts_of(world, 1, own), 2U);
    EXPECT_EQ(own[0].other, body_of(0));
    EXPECT_EQ(own[1].other, body_of(2));
    EXPECT_NEAR(own[0].normal.y, 1.0, 1e-12);
    EXPECT_EQ(own[0].normal_impulse, found[0].normal_impulse);
    EXPECT_EQ(contacts_of(world, 4, own), 0U);
}

TEST(Contacts, WhatHasNoRoomIsCountedAndTheFirstAreKept)
{
    World world = frozen(tower(4));
    run(world, 100);
    std::array<Contact, 4> all;
    std::array<Contact, 2> few;
    ASSERT_EQ(contacts(world, all), 4U);
    EXPECT_EQ(contacts(world, few), 4U);
    EXPECT_EQ(contacts(world, {}), 4U);
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].body, all[i].body);
        EXPECT_EQ(few[i].other, all[i].other);
    }
}

TEST(Contacts, ACubeThatAHandPressesAgainstAWallPushesItAsHard)
{
    for (const bool turns : {false, true}) {
        Description scene = cube_on_plane();
        scene.bodies[1].position = {{0.04, 0.0, 0.0}};
        if (turns) scene.bodies[0].turning = Turning::free;
        World world = frozen(scene);
        ASSERT_FALSE(world.set_hand(0, {.position = {{-0.0235, 0.0, 0.0}}, .velocity = {}}));
        run(world, 500);
        std::array<Contact, 4> found;
        ASSERT_EQ(contacts(world, found), 2U);
        EXPECT_EQ(found[0].other, body_of(1));
        EXPECT_NEAR(found[0].normal.x, -1.0, 1e-9);
        EXPECT_NEAR(world.touch(0).on_body.x(), 0.75, 1e-6); // 1.5 mm deep
        EXPECT_NEAR(found[0].normal_impulse, world.touch(0).on_body.x() * tick_s, 1e-9 * tick_s);
        EXPECT_NEAR(found[1].normal_impulse, weight * tick_s, 1e-9 * tick_s);
    }
}

TEST(Contacts, ABounceGivesTwiceTheMomentumAndIsListedThoughTheyHaveParted)
{
    for (const bool turns : {false, true}) {
        Description scene = cube_on_plane();
        scene.planes.clear();
        scene.gravity = glm::dvec3{0.0};
        scene.bodies[0].drag_ns_per_m = 0.0;
        scene.bodies[0].turning = turns ? Turning::free : Turning::locked;
        scene.bodies[0].velocity = {{1.0, 0.0, 0.0}};
        scene.bodies[1].position = {{0.0405, 0.0, 0.0}}; // in half a tick
        scene.bodies[1].material.restitution = 1.0;
        World world = frozen(scene);
        std::array<Contact, 2> found;
        EXPECT_EQ(contacts(world, found), 0U);
        world.tick();
        ASSERT_EQ(contacts(world, found), 1U);
        EXPECT_NEAR(world.velocity(0).x(), -1.0, 1e-12);
        EXPECT_NEAR(found[0].normal_impulse, 0.2, 1e-12);
        EXPECT_NEAR(found[0].normal.x, -1.0, 1e-12);
        EXPECT_NEAR(found[0].separation, 5e-4, 1e-9);
        world.tick();
        EXPECT_EQ(contacts(world, found), 0U);
    }
}

TEST(Contacts, ALandingGivesTheMomentumThatItStopsAndThenTheWeight)
{
    Description scene = cube_on_plane();
    scene.bodies[0].position = {{0.0, 0.01, 0.0}};
    World world = frozen(scene);
    std::array<Contact, 2> found;
    double given = 0.0;
    int ticks = 0;
    for (; ticks < 100; ++ticks) {
        world.tick();
        if (contacts(world, found) > 0) given += found[0].normal_impulse;
    }
    EXPECT_EQ(world.velocity(0).y(), 0.0);
    EXPECT_NEAR(given, ticks * weight * tick_s, 1e-15); // no momentum at start and end
}

TEST(Contacts, WhatAPushAddsIsCarried)
{
    World world = frozen(cube_on_plane());
    run(world, 10);
    ASSERT_FALSE(world.push(0, {{0.0, -2.0, 0.0}}));
    world.tick();
    std::array<Contact, 2> found;
    ASSERT_EQ(contacts(world, found), 1U);
    EXPECT_NEAR(found[0].normal_impulse, (2.0 + weight) * tick_s, 1e-15);
    world.tick();
    ASSERT_EQ(contacts(world, found), 1U);
    EXPECT_NEAR(found[0].normal_impulse, weight * tick_s, 1e-15);
}

TEST(RayCast, FindsTheFirstBodyOrPlane)
{
    World world = frozen(tower(2)); // cubes of 40 mm at y = 0 and 0.04 on a plane at -0.02
    auto hit = cast_ray(world, {.origin = {{-1.0, 0.001, 0.002}}, .direction = {2.0, 0.0, 0.0}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->what, body_of(0));
    EXPECT_NEAR(hit->distance_m, 0.98, 1e-15);
    EXPECT_EQ(hit->normal, (glm::dvec3{-1.0, 0.0, 0.0}));
    EXPECT_LE(length(hit->at.value - glm::dvec3{-0.02, 0.001, 0.002}), 1e-15);
    hit = cast_ray(world, {.origin = {{0.5, 1.0, 0.0}}, .direction = {0.0, -1.0, 0.0}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->what, plane_of(0));
    EXPECT_NEAR(hit->distance_m, 1.02, 1e-15);
    EXPECT_EQ(hit->normal, (glm::dvec3{0.0, 1.0, 0.0}));
    hit = cast_ray(world, {.origin = {{0.0, 1.0, 0.0}}, .direction = {0.0, -1.0, 0.0}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->what, body_of(1));
    EXPECT_NEAR(hit->distance_m, 0.94, 1e-15);
}

TEST(RayCast, EndsAtItsLengthAndBeginsInsideAtOnce)
{
    World world = frozen(tower(1));
    const Ray ray{.origin = {{-1.0, 0.0, 0.0}}, .direction = {1.0, 0.0, 0.0}, .length_max_m = 0.97};
    EXPECT_FALSE(cast_ray(world, ray));
    const auto inside = cast_ray(world, {.origin = {}, .direction = {0.0, 3.0, 4.0}});
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->distance_m, 0.0);
    EXPECT_LE(length(inside->normal - glm::dvec3{0.0, -0.6, -0.8}), 1e-15);
    EXPECT_FALSE(cast_ray(world, {.origin = {{1.0, 1.0, 0.0}}, .direction = {0.0, 1.0, 0.0}}));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(cast_ray(world, {.origin = {{nan, 0.0, 0.0}}}));
    EXPECT_FALSE(cast_ray(world, {.origin = {}, .direction = {nan, 0.0, 0.0}}));
    EXPECT_FALSE(cast_ray(world, {.origin = {}, .direction = {}}));
}

TEST(Separations, OfAPointOfBodiesAndInASphere)
{
    World world = frozen(tower(3));
    const auto above = separation(world, {{0.0, 0.2, 0.0}}, 2);
    EXPECT_NEAR(above.distance, 0.1, 1e-15);
    EXPECT_EQ(above.direction, (glm::dvec3{0.0, 1.0, 0.0}));
    const auto inside = separation(world, {{0.015, 0.0, 0.0}}, 0);
    EXPECT_NEAR(inside.distance, -0.005, 1e-17);
    EXPECT_EQ(inside.direction, (glm::dvec3{1.0, 0.0, 0.0}));
    EXPECT_LE(length(inside.on_second - glm::dvec3{0.02, 0.0, 0.0}), 1e-17);
    EXPECT_NEAR(separation(world, 0, 2).distance, 0.04, 1e-15);
    EXPECT_NEAR(separation(world, 0, 2).direction.y, -1.0, 1e-15);

    const auto nearest = nearest_body(world, {{0.05, 0.045, 0.0}});
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->body, 1U);
    EXPECT_NEAR(nearest->separation.distance, 0.03, 1e-15);
    std::array<BodyId, 3> found{};
    EXPECT_EQ(bodies_in_sphere(world, {{0.05, 0.02, 0.0}}, 0.031, found), 2U);
    EXPECT_EQ(found[0], 0U);
    EXPECT_EQ(found[1], 1U);
    EXPECT_EQ(bodies_in_sphere(world, {{0.05, 0.02, 0.0}}, 0.029, found), 0U);
    EXPECT_EQ(bodies_in_sphere(world, {{0.0, 0.04, 0.0}}, 1.0, std::span{found}.first(1)), 3U);
    EXPECT_FALSE(nearest_body(frozen(Description{}), {}));
}

TEST(Query, TakesNoMemoryAndChangesNothing)
{
    World world = frozen(tower(4));
    run(world, 50);
    const World copy = world;
    const auto hash = world.hash();
    std::array<Contact, 8> room;
    std::array<Contact, 8> of_copy;
    std::array<BodyId, 8> bodies{};
    const auto before = test::allocations();
    const std::size_t found = contacts(world, room);
    EXPECT_EQ(contacts(copy, of_copy), found);
    EXPECT_TRUE(cast_ray(world, {.origin = {{-1.0, 0.0, 0.0}}}));
    EXPECT_TRUE(nearest_body(world, {{1.0, 0.0, 0.0}}));
    EXPECT_GT(separation(world, 0, 3).distance, 0.0);
    EXPECT_EQ(bodies_in_sphere(world, {}, 1.0, bodies), 4U);
    EXPECT_EQ(test::allocations(), before);
    EXPECT_EQ(world.hash(), hash);
    for (std::size_t i = 0; i < found; ++i)
        EXPECT_EQ(of_copy[i].normal_impulse, room[i].normal_impulse);
}

} // namespace
} // namespace hapnet::scene::query_test
