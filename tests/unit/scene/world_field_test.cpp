// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Fields of force on bodies and on hands, against formulas.
#include "proto/base/math.hpp"
#include "scene/maths/vector.hpp"
#include "scene/text/text.hpp"
#include "scene/world.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene::world_field_test {
namespace {

using namespace std::chrono_literals;

constexpr double mass = 0.1;

/// A cube of 100 g in space, and a field on bodies.
Description cube_in(const FieldDescription& field)
{
    Description scene;
    scene.gravity = glm::dvec3{0.0};
    scene.hands.count = 0;
    scene.bodies.resize(1);
    scene.fields = {field};
    scene.fields[0].on_bodies = true;
    return scene;
}

void run(World& world, int ticks)
{
    for (int i = 0; i < ticks; ++i) world.tick();
}

TEST(Field, AConstantForceMakesAParabola)
{
    for (const bool on_plane : {false, true}) {
        FieldDescription field;
        field.force = {{0.2, 0.0, -0.1}};
        Description scene = cube_in(field);
        if (on_plane) scene.planes.push_back({.name = {}, .offset_m = -1.0});
        World world = World::freeze(scene).value();
        EXPECT_EQ(world.stepper_kind(), on_plane ? StepperKind::lone : StepperKind::flight);
        run(world, 1000);
        EXPECT_LE(length(world.position(0).value - glm::dvec3{1.0, 0.0, -0.5}), 1e-12);
        EXPECT_LE(length(world.velocity(0).value - glm::dvec3{2.0, 0.0, -1.0}), 1e-12);
    }
}

TEST(Field, OutsideOfItsRegionIsNothing)
{
    FieldDescription field;
    field.force = {{1.0, 0.0, 0.0}};
    field.half = glm::dvec3{0.05, 1.0, 1.0};
    World world = World::freeze(cube_in(field)).value();
    run(world, 1000); // 5 cm at 10 m/s^2: 1 m/s, and then straight on
    EXPECT_NEAR(world.velocity(0).x(), 1.0, 0.01);
    const double out = world.velocity(0).x();
    run(world, 100);
    EXPECT_EQ(world.velocity(0).x(), out);
}

TEST(Field, AViscousRegionSlowsExponentiallyHoweverThick)
{
    for (const double damping : {0.5, 5.0, 5000.0}) {
        FieldDescription field;
        field.damping_ns_per_m = damping;
        Description scene = cube_in(field);
        scene.bodies[0].velocity = {{1.0, -2.0, 0.5}};
        World world = World::freeze(scene).value();
        run(world, 50);
        const double keeps = base::exp(-damping * 0.05 / mass);
        EXPECT_LE(length(world.velocity(0).value - keeps * scene.bodies[0].velocity.value), 1e-12);
    }
}

double guide_error(base::Duration tick)
{
    FieldDescription field;
    field.stiffness_n_per_m = 100.0;
    field.line = glm::dvec3{1.0, 0.0, 0.0};
    Description scene = cube_in(field);
    scene.bodies[0].position = {{0.0, 0.01, 0.0}};
    scene.bodies[0].velocity = {{0.3, 0.0, 0.0}};
    World world = World::freeze(scene, {.tick = tick}).value();
    run(world, static_cast<int>(std::lround(0.2 / base::to_seconds(tick))));
    EXPECT_NEAR(world.position(0).x(), 0.06, 1e-13); // along the line it is free
    const double frequency = std::sqrt(100.0 / mass);
    return std::abs(world.position(0).y() - 0.01 * base::cos(0.2 * frequency));
}

TEST(Field, AGuideIsAnOscillatorAcrossItsLineOfSecondOrder)
{
    const double coarse = guide_error(1ms);
    const double fine = guide_error(500us);
    EXPECT_LE(coarse, 1e-5);
    EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(Field, AGuideNeitherGainsNorLosesEnergyHoweverStiff)
{
    for (const double stiffness : {100.0, 1e5, 1e8}) {
        FieldDescription field;
        field.stiffness_n_per_m = stiffness;
        Description scene = cube_in(field);
        scene.bodies[0].position = {{1e-5, -2e-5, 0.0}};
        World world = World::freeze(scene).value();
        const auto energy = [&] {
            const glm::dvec3 x = world.position(0).value;
            const glm::dvec3 v = world.velocity(0).value;
            return 0.5 * (stiffness * glm::dot(x, x) + mass * glm::dot(v, v));
        };
        const double before = energy();
        run(world, 2000);
        EXPECT_NEAR(energy() / before, 1.0, 1e-9) << stiffness;
    }
}

TEST(Field, AWeightOnAGuideComesToRestWhereTheyBalance)
{
    FieldDescription field;
    field.stiffness_n_per_m = 200.0;
    field.damping_ns_per_m = 4.0;
    Description scene = cube_in(field);
    scene.gravity = {0.0, -9.81, 0.0};
    World world = World::freeze(scene).value();
    run(world, 3000);
    EXPECT_NEAR(world.position(0).y(), -mass * 9.81 / 200.0, 1e-12);
}

TEST(Field, AHandFeelsTheMeanOverTheTick)
{
    FieldDescription field;
    field.position = {{0.0, 0.1, 0.0}};
    field.stiffness_n_per_m = 100.0;
    field.damping_ns_per_m = 3.0;
    field.line = glm::dvec3{1.0, 0.0, 0.0};
    field.half = glm::dvec3{0.5};
    field.force_limit_n = 10.0;
    Description scene;
    scene.hands.count = 1;
    scene.fields = {field};
    World world = World::freeze(scene).value();
    const auto felt = [&](const glm::dvec3& place, const glm::dvec3& velocity) {
        EXPECT_FALSE(world.set_hand(0, {.position = {place}, .velocity = {velocity}}));
        world.tick();
        return world.touch(0).on_hand.value;
    };
    EXPECT_LE(length(felt({0.2, 0.12, 0.0}, {}) - glm::dvec3{0.0, -2.0, 0.0}), 1e-12);
    const glm::dvec3 moving = felt({0.2, 0.12, 0.0}, {1.0, 0.2, 0.0});
    EXPECT_LE(length(moving - glm::dvec3{-3.0, -100.0 * 0.0201 - 0.6, 0.0}), 1e-12);
    EXPECT_NEAR(world.touch(0).on_hand_at_start.y(), -2.6, 1e-12);
    EXPECT_NEAR(length(felt({0.0, 0.3, 0.0}, {0.0, 0.0, 0.0})), 10.0, 1e-12); // 20 N, limited
    EXPECT_EQ(felt({0.0, 0.7, 0.0}, {}), glm::dvec3{0.0});                    // outside
}

TEST(Field, TheSceneOfAGuideGuidesAndReadsBackAsItself)
{
    const auto scene = load_scene("guide", {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(parse_scene(to_text(*scene), "again").value(), *scene);
    World world = World::freeze(*scene).value();
    EXPECT_EQ(world.stepper_kind(), StepperKind::few);
    ASSERT_FALSE(world.set_hand(0, {.position = {{0.0, 0.12, 0.0}}, .velocity = {}}));
    run(world, 3000);
    EXPECT_NEAR(world.touch(0).on_hand.y(), -300.0 * 0.02, 1e-9);   // to its line at 100 mm
    EXPECT_LT(world.position(1).x(), world.position(0).x() - 0.05); // one went through honey
}

TEST(Field, CostsAFeatureAndAHashOnlyWhereItIsAndIsChecked)
{
    Description scene = paper_scene();
    const auto before = hash(scene);
    const auto needs = [&] {
        return required_features(requirements_of(scene, true)).has(Feature::fields);
    };
    EXPECT_FALSE(needs());
    scene.fields.resize(1);
    EXPECT_TRUE(needs());
    EXPECT_EQ(World::freeze(scene).value().stepper_kind(), StepperKind::sliding);
    EXPECT_NE(hash(scene), before);
    scene.fields[0].stiffness_n_per_m = -1.0;
    EXPECT_EQ(check(scene).error().message,
              "field 1 '': stiffness in N/m is -1; it can be 0 to 1000000000");
    scene.fields[0].stiffness_n_per_m = 1.0;
    scene.fields[0].line = glm::dvec3{1.0, 1.0, 0.0};
    EXPECT_FALSE(check(scene));
}

} // namespace
} // namespace hapnet::scene::world_field_test
