// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Bodies of several parts: where their mass is, and that they move as one piece.
#include "proto/base/math.hpp"
#include "scene/query.hpp"
#include "scene/requirements.hpp"
#include "scene/text/text.hpp"
#include "tests/unit/scene/rigid/scenes.hpp"

#include <array>
#include <gtest/gtest.h>

namespace hapnet::scene::world_parts_test {
namespace {

using namespace std::chrono_literals;

PartDescription part(const glm::dvec3& half_edges, const glm::dvec3& place)
{
    return {.half = half_edges, .position = {place}};
}

/// A box whose first part ends at x = cut, cut from its lower end.
BodyDescription cut_box(const glm::dvec3& half_edges, double cut)
{
    BodyDescription body = cube_at({});
    const double first = 0.5 * cut;
    const double second = half_edges.x - first;
    body.half = {first, half_edges.y, half_edges.z};
    body.position.value.x = first - half_edges.x;
    body.parts.push_back(part({second, half_edges.y, half_edges.z}, {first + second, 0.0, 0.0}));
    return body;
}

/// Two legs, one along x and one that rises from the end of it; their corner at the origin.
BodyDescription angle(double along, double up, double thick)
{
    BodyDescription body = cube_at({0.5 * along, 0.5 * thick, 0.0});
    body.name = "angle";
    body.half = {0.5 * along, 0.5 * thick, 0.5 * thick};
    const double rise = 0.5 * (up - thick);
    body.parts.push_back(
        part({0.5 * thick, rise, 0.5 * thick}, {0.5 * (thick - along), 0.5 * thick + rise, 0.0}));
    return body;
}

TEST(Compounds, ABoxInTwoPiecesHasItsCentreAndItsMoments)
{
    const glm::dvec3 edges{0.03, 0.02, 0.01};
    for (const double cut : {0.007, 0.03, 0.05}) {
        const BodyDescription body = cut_box(edges, cut);
        EXPECT_LT(length(frame_of_mass(body).centre.value), 1e-17);
        EXPECT_LT(length(inertia_of(body) - box_inertia(0.1, edges)), 1e-19);
        EXPECT_NEAR(mass_of(body, 1000.0), 8000.0 * 0.03 * 0.02 * 0.01, 1e-15);
    }
}

TEST(Compounds, AnAngleHasTheMassOfTheFormulas)
{
    // Two rods with square sections: computed by areas.
    constexpr double along = 0.08, up = 0.05, thick = 0.02;
    const BodyDescription body = angle(along, up, thick);
    const double lying = along * thick, rising = (up - thick) * thick;
    const double all = lying + rising;
    const glm::dvec3 centre{(lying * 0.5 * along + rising * 0.5 * thick) / all,
                            (lying * 0.5 * thick + rising * 0.5 * (thick + up)) / all, 0.0};
    const MassFrame frame = frame_of_mass(body);
    EXPECT_LT(length(frame.centre.value - centre), 1e-16);
    const auto rod = [&](double area, double x, double y, double a, double b) {
        const double m = 0.1 * area / all;
        const double dx = x - centre.x, dy = y - centre.y;
        return std::array{m * (b * b / 12.0 + dy * dy), m * (a * a / 12.0 + dx * dx), m * dx * dy};
    };
    const auto one = rod(lying, 0.5 * along, 0.5 * thick, along, thick);
    const auto two = rod(rising, 0.5 * thick, 0.5 * (thick + up), thick, up - thick);
    const double of_depth = 0.1 * thick * thick / 12.0;
    const double xx = one[0] + two[0] + of_depth, yy = one[1] + two[1] + of_depth;
    const double xy = -(one[2] + two[2]);
    const double zz = xx + yy - 2.0 * of_depth;
    const double middle = 0.5 * (xx + yy);
    const double apart = std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    const glm::dvec3 moments = inertia_of(body);
    EXPECT_NEAR(std::min(moments.x, moments.y), middle - apart, 1e-18);
    EXPECT_NEAR(std::max(moments.x, moments.y), middle + apart, 1e-18);
    EXPECT_NEAR(moments.z, zz, 1e-18);
    // The body's axes: no product of inertia is left about them.
    const glm::dmat3 axes = glm::mat3_cast(frame.orientation);
    const glm::dvec3 axis = moments.x < moments.y ? axes[0] : axes[1];
    EXPECT_NEAR(xx * axis.x + xy * axis.y, (middle - apart) * axis.x, 1e-18);
    EXPECT_NEAR(xy * axis.x + yy * axis.y, (middle - apart) * axis.y, 1e-18);
}

TEST(Compounds, AHammerOfRoundPartsHasTheSumOfTheirMoments)
{
    BodyDescription hammer = cube_at({});
    hammer.half = {0.04, 0.015, 0.015};
    hammer.parts.push_back({Shape::capsule, {0.008, 0.1, 0.008}, {{0.0, 0.1, 0.0}}, {1, 0, 0, 0}});
    hammer.parts.push_back({Shape::sphere, glm::dvec3{0.01}, {{0.0, 0.2, 0.0}}, {1, 0, 0, 0}});
    glm::dvec3 sum{0.0};
    double weighed = 0.0, whole = 0.0;
    std::array<BodyDescription, 3> alone{cube_at({}), cube_at({}), cube_at({})};
    const std::array<double, 3> heights{0.0, 0.1, 0.2};
    alone[0].half = hammer.half;
    for (std::size_t i = 0; i < 2; ++i) {
        alone[i + 1].shape = hammer.parts[i].shape;
        alone[i + 1].half = hammer.parts[i].half;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        weighed += mass_of(alone[i], 1.0) * heights[i];
        whole += mass_of(alone[i], 1.0);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        alone[i].mass_kg = 0.1 * mass_of(alone[i], 1.0) / whole;
        const double off = heights[i] - weighed / whole;
        sum += inertia_of(alone[i]) + alone[i].mass_kg * off * off * glm::dvec3{1.0, 0.0, 1.0};
    }
    EXPECT_LT(length(inertia_of(hammer) - sum), 1e-17);
    EXPECT_NEAR(frame_of_mass(hammer).centre.y(), weighed / whole, 1e-16);
}

TEST(Compounds, ABoxInTwoPiecesFliesLandsAndSlidesAsTheBox)
{
    const glm::dvec3 edges{0.03, 0.02, 0.02};
    for (const bool is_cut : {false, true}) {
        Description scene = platform();
        BodyDescription body = is_cut ? cut_box(edges, 0.02) : cube_at({});
        body.half = is_cut ? body.half : edges;
        body.position.value.y = half + 0.05;
        body.velocity.value = {0.5, 0.0, 0.0};
        scene.bodies.push_back(body);
        World world = world_of(scene);
        run(world, 1500);
        const BodyState state = world.body(0);
        EXPECT_NEAR(state.position.y(), half, 1e-8);
        EXPECT_LT(rotated(state), 1e-7);
        EXPECT_LT(length(state.velocity.value), 1e-9);
        // v^2 / 2 mu g, and what it flew: the landing takes mu times the speed of the fall.
        const double fall = std::sqrt(2.0 * gravity * 0.05);
        const double slide = 0.5 - friction * fall;
        const double way = 0.5 * fall / gravity + slide * slide / (2.0 * friction * gravity);
        EXPECT_NEAR(state.position.x(), way, 1.5e-3);
    }
}

TEST(Compounds, AnAngleThatStandsOnItsLegStaysWhereItIs)
{
    Description scene = platform();
    scene.bodies.push_back(angle(0.08, 0.05, 0.02));
    World world = world_of(scene);
    const BodyState before = world.body(0);
    run(world, 2000);
    const BodyState after = world.body(0);
    EXPECT_LT(length(after.position.value - before.position.value), 1e-8);
    EXPECT_GT(std::abs(glm::dot(after.orientation, before.orientation)), 1.0 - 1e-14);
    EXPECT_NEAR(separation(world, base::Position{{0.04, -0.01, 0.0}}, 0).distance, 0.01, 1e-7);
}

/// A post with an arm of length `reach` at its top.
BodyDescription gallows(double reach)
{
    BodyDescription body = cube_at({0.0, 0.05, 0.0});
    body.half = {0.01, 0.05, 0.01};
    body.parts.push_back(part({0.5 * reach, 0.01, 0.01}, {0.01 + 0.5 * reach, 0.04, 0.0}));
    return body;
}

TEST(Compounds, AGallowsTipsWhereItsCentreOfMassIsBesideItsFoot)
{
    // The post weighs 0.1 and the arm its reach, per 1/(4e-4): level where their moments about the
    // edge of the foot are equal.
    const double level = std::sqrt(2.0 * 0.1 * 0.01);
    for (const double share : {0.97, 1.03}) {
        Description scene = platform();
        scene.bodies.push_back(gallows(share * level));
        EXPECT_EQ(frame_of_mass(scene.bodies[0]).centre.x() > 0.01, share > 1.0);
        World world = world_of(scene);
        const glm::dquat before = world.body(0).orientation;
        run(world, 3000);
        const double alike = std::abs(glm::dot(world.body(0).orientation, before));
        if (share < 1.0) {
            EXPECT_GT(alike, 1.0 - 1e-12);
        } else {
            EXPECT_LT(alike, 0.95); // it lies
            EXPECT_LT(length(world.body(0).velocity.value), 1e-3);
            EXPECT_GT(separation(world, base::Position{{0.0, -1.0, 0.0}}, 0).distance, 1.0 - 1e-4);
        }
    }
}

TEST(Compounds, AnAngleThatFliesKeepsItsMomentumAndItsEnergy)
{
    Description scene;
    scene.hands.count = 0;
    scene.gravity = glm::dvec3{0.0};
    BodyDescription body = angle(0.08, 0.05, 0.02);
    body.angular_velocity = {3.0, 20.0, -7.0};
    body.velocity.value = {0.1, 0.2, 0.3};
    scene.bodies.push_back(body);
    World world = world_of(scene);
    const double before = energy(world);
    const glm::dvec3 momentum = world.state().bodies.angular_momentum.at(0);
    const glm::dvec3 from = world.position(0).value;
    run(world, 1000);
    EXPECT_NEAR(energy(world), before, 2e-5 * before); // of second order: see FreeFlight
    EXPECT_LT(length(world.state().bodies.angular_momentum.at(0) - momentum), 1e-15);
    EXPECT_LT(length(world.position(0).value - from - body.velocity.value), 1e-12);
}

TEST(Compounds, AnAngleThatTumblesGainsNoEnergy)
{
    for (const double rough : {0.0, 0.4, 2.0}) {
        for (const double bounce : {0.0, 0.5}) {
            Description scene = platform();
            BodyDescription body = angle(0.08, 0.05, 0.02);
            body.position.value.y += 0.15;
            body.orientation = base::normalized(glm::dquat{0.9, 0.3, 0.1, -0.2});
            body.angular_velocity = {5.0, -3.0, 8.0};
            body.material = {rough, bounce};
            scene.planes[0].material.friction = rough;
            scene.bodies.push_back(body);
            World world = world_of(scene);
            const double start = energy(world);
            double gained = 0.0, last = start;
            for (int tick = 0; tick < 2000; ++tick) {
                world.tick();
                const double now = energy(world);
                gained += std::max(0.0, now - last);
                last = now;
            }
            EXPECT_LT(last, start);
            EXPECT_LT(gained, 0.03 * start) << rough << " " << bounce;
            EXPECT_GT(separation(world, base::Position{{0.0, -10.0, 0.0}}, 0).distance,
                      10.0 - 1e-3);
        }
    }
}

TEST(Compounds, WhatFliesThroughAForkTouchesNothing)
{
    Description scene;
    scene.hands.count = 0;
    scene.gravity = glm::dvec3{0.0};
    BodyDescription fork = cube_at({0.0, -0.05, 0.0});
    fork.half = {0.05, 0.01, 0.01};
    for (const double side : {-1.0, 1.0})
        fork.parts.push_back(part({0.01, 0.03, 0.01}, {0.04 * side, 0.04, 0.0}));
    scene.bodies.push_back(fork);
    for (const double speed : {1.0, 100.0}) {
        BodyDescription ball = cube_at({0.0, 0.0, -0.1});
        ball.half = glm::dvec3{0.015};
        ball.velocity.value = {0.0, 0.0, speed};
        scene.bodies.resize(1);
        scene.bodies.push_back(ball);
        World world = world_of(scene);
        run(world, speed > 10.0 ? 4 : 250);
        EXPECT_EQ(world.velocity(1).value, ball.velocity.value);
        EXPECT_EQ(world.velocity(0).value, glm::dvec3{0.0});
        EXPECT_GT(world.position(1).z(), 0.1);
        // A body that flies at a prong is stopped by it.
        scene.bodies[1].position.value.x = 0.04;
        World hit = world_of(scene);
        run(hit, speed > 10.0 ? 4 : 250);
        EXPECT_LT(hit.velocity(1).z(), 0.9 * speed);
        EXPECT_GT(hit.velocity(0).z(), 0.0);
    }
}

TEST(Compounds, AHandFeelsFacesThatLieFlushAsOne)
{
    const glm::dvec3 edges{0.03, 0.02, 0.02};
    const auto felt = [&](bool is_cut, bool is_movable) {
        Description scene;
        scene.gravity = glm::dvec3{0.0};
        BodyDescription body = is_cut ? cut_box(edges, 0.03) : cube_at({});
        body.half = is_cut ? body.half : edges;
        body.movable = is_movable;
        scene.bodies.push_back(body);
        scene.bodies.push_back(cube_at({10.0, 0.0, 0.0})); // hands feel nothing where all is fixed
        World world = world_of(scene);
        glm::dvec3 sum{0.0};
        for (int tick = 0; tick < 200; ++tick) {
            // It slides over where the pieces meet.
            const double x = -0.01 + 1e-4 * tick;
            EXPECT_FALSE(
                world.set_hand(0, {.position = {{x, 0.0245, 0.0}}, .velocity = {{0.1, 0.0, 0.0}}}));
            world.tick();
            sum += world.touch(0).on_hand.value;
        }
        return sum;
    };
    const glm::dvec3 still = felt(false, false);
    EXPECT_GT(still.y, 0.0);
    EXPECT_LT(length(felt(true, false) - still), 1e-9 * length(still));
    const glm::dvec3 pushed = felt(false, true);
    EXPECT_LT(length(felt(true, true) - pushed), 1e-3 * length(pushed));
}

TEST(Compounds, AHandInTheCornerOfAnAngleFeelsBothLegs)
{
    Description scene;
    scene.gravity = glm::dvec3{0.0};
    BodyDescription body = angle(0.08, 0.08, 0.02);
    body.movable = false;
    scene.bodies.push_back(body);
    scene.bodies.push_back(cube_at({10.0, 0.0, 0.0}));
    World world = world_of(scene);
    ASSERT_FALSE(world.set_hand(0, {.position = {{0.024, 0.024, 0.0}}}));
    world.tick();
    const glm::dvec3 force = world.touch(0).on_hand.value;
    const double each = 0.001 * scene.hands.stiffness_n_per_m;
    EXPECT_LT(length(force - glm::dvec3{each, each, 0.0}), 1e-9);
}

TEST(Compounds, AHandThatHoldsTheHandleTurnsTheHammer)
{
    Description scene;
    scene.gravity = glm::dvec3{0.0};
    BodyDescription hammer = cube_at({0.0, 0.0, 0.0});
    hammer.half = {0.03, 0.015, 0.015};
    hammer.parts.push_back(part({0.008, 0.06, 0.008}, {0.0, -0.075, 0.0}));
    scene.bodies.push_back(hammer);
    World world = world_of(scene);
    const glm::dvec3 from = world.position(0).value;
    HandInput hand{.position = {{0.0, -0.12, 0.0}}, .gripping = true};
    hand.velocity.value = {0.05, 0.0, 0.0};
    for (int tick = 0; tick < 200; ++tick) {
        ASSERT_FALSE(world.set_hand(0, hand));
        world.tick();
        EXPECT_TRUE(world.touch(0).holding);
        EXPECT_EQ(world.touch(0).body, 0U);
        hand.position.value += 1e-3 * hand.velocity.value;
    }
    EXPECT_GT(world.body(0).angular_velocity.z, 0.01); // the head lags behind
    EXPECT_GT(world.position(0).x(), from.x);
}

TEST(Compounds, QuestionsSeeTheParts)
{
    Description scene = platform();
    scene.bodies.push_back(angle(0.08, 0.05, 0.02));
    scene.bodies.push_back(cube_at({0.06, 0.04, 0.0}));
    World world = world_of(scene);
    run(world, 300);
    // Over the upright leg and the lying one, into the cube on it.
    const auto over = cast_ray(world, {.origin = {{0.03, 0.045, -1.0}}, .direction = {0, 0, 1}});
    EXPECT_FALSE(over);
    const auto leg = cast_ray(world, {.origin = {{0.01, 0.045, -1.0}}, .direction = {0, 0, 1}});
    ASSERT_TRUE(leg);
    EXPECT_NEAR(leg->distance_m, 0.99, 1e-6);
    EXPECT_NEAR(separation(world, base::Position{{0.03, 0.03, 0.0}}, 0).distance, 0.01, 1e-6);
    EXPECT_NEAR(separation(world, 0, 1).distance, 0.0, 1e-6);
    std::array<Contact, 8> room{};
    const std::size_t found = contacts(world, room);
    ASSERT_EQ(found, 2U);
    EXPECT_EQ(room[0].other, (Thing{Thing::Kind::body, 1}));
    EXPECT_NEAR(room[0].normal_impulse, 0.1 * gravity * 1e-3, 1e-8);
    EXPECT_EQ(room[1].other, (Thing{Thing::Kind::plane, 0}));
    EXPECT_NEAR(room[1].normal_impulse, 0.2 * gravity * 1e-3, 1e-8);
}

TEST(Compounds, SleepAndWakeInOnePiece)
{
    Description scene = platform();
    scene.bodies.push_back(angle(0.08, 0.05, 0.02));
    scene.bodies.push_back(cube_at({0.06, 0.04, 0.0}));
    World world = World::freeze(scene).value();
    run(world, 1000);
    EXPECT_FALSE(world.is_awake(0));
    EXPECT_FALSE(world.is_awake(1));
    ASSERT_FALSE(world.push(0, base::Force{{5.0, 0.0, 0.0}}));
    run(world, 2);
    EXPECT_TRUE(world.is_awake(0));
    EXPECT_TRUE(world.is_awake(1));
}

TEST(Compounds, AreRefusedWithWhatIsWrong)
{
    Description scene = platform();
    scene.bodies.push_back(angle(0.08, 0.05, 0.02));
    scene.bodies[0].parts[0].shape = Shape::sphere;
    ASSERT_FALSE(check(scene));
    EXPECT_NE(check(scene).error().message.find("sphere are equal"), std::string::npos);
    scene.bodies[0].parts.assign(parts_max + 1, part(glm::dvec3{0.01}, {0.0, 0.1, 0.0}));
    ASSERT_FALSE(check(scene));
    EXPECT_NE(check(scene).error().message.find("more than 15 further parts"), std::string::npos);
}

TEST(Compounds, ArePartOfTheHashTheTextAndTheNeeds)
{
    Description scene = platform();
    scene.bodies.push_back(angle(0.08, 0.05, 0.02));
    Description other = scene;
    other.bodies[0].parts[0].position.value.x += 1e-9;
    EXPECT_NE(hash(scene), hash(other));
    EXPECT_EQ(parse_scene(to_text(scene), "scene").value(), scene);
    const FeatureSet needs = required_features(requirements_of(scene, true));
    EXPECT_TRUE(needs.has(Feature::compounds));
    EXPECT_EQ(cheapest_stepper(needs), StepperKind::lone);
    scene.bodies[0].parts.clear();
    EXPECT_FALSE(required_features(requirements_of(scene, true)).has(Feature::compounds));
}

} // namespace
} // namespace hapnet::scene::world_parts_test
