// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Scenes that people build every day, with values that formulas give.
#include "scene/world.hpp"
#include "tests/support/scene/everyday.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace everyday {
namespace {

using namespace std::chrono_literals;

constexpr double weight_per_mass = 9.81; // N/kg

BodyDescription box(const glm::dvec3& half, const glm::dvec3& at)
{
    BodyDescription body;
    body.half = half;
    body.position.value = at;
    return body;
}

BodyDescription fixed(BodyDescription body)
{
    body.movable = false;
    return body;
}

BodyDescription ball(double radius, const glm::dvec3& at)
{
    BodyDescription body = box(glm::dvec3{radius}, at);
    body.shape = Shape::sphere;
    return body;
}

BodyDescription capsule(double radius, double half_length, const glm::dvec3& at)
{
    BodyDescription body = box({radius, radius, half_length}, at);
    body.shape = Shape::capsule;
    return body;
}

enum class Floor { slab, tiles, compound };

/// A floor with its surface at y = 0, of one box or of ten by two that lie flush.
Description on_floor(Floor floor, double friction)
{
    constexpr double edge = 0.08;
    Description scene;
    scene.hands.count = 0;
    BodyDescription whole = fixed(box({5.0 * edge, 0.5 * edge, edge}, {}));
    whole.position.value = {4.5 * edge, -0.5 * edge, 0.0};
    BodyDescription tile = fixed(box(glm::dvec3{0.5 * edge}, {}));
    const glm::dvec3 first{0.0, -0.5 * edge, -0.5 * edge};
    if (floor == Floor::slab) scene.bodies.push_back(whole);
    for (int x = 0; x < 10 && floor != Floor::slab; ++x) {
        for (int z = 0; z < 2; ++z) {
            const glm::dvec3 from_first = edge * glm::dvec3{x, 0.0, z};
            tile.position.value = first + from_first;
            if (floor == Floor::tiles || scene.bodies.empty())
                scene.bodies.push_back(tile);
            else if (scene.bodies[0].parts.size() < parts_max)
                scene.bodies[0].parts.push_back({.half = tile.half, .position = {from_first}});
        }
    }
    for (BodyDescription& body : scene.bodies) body.material.friction = friction;
    return scene;
}

/// Returns the place after half a second of a body that slides over a floor.
glm::dvec3 slid(Floor floor, BodyDescription body, double friction)
{
    Description scene = on_floor(floor, friction);
    body.material.friction = friction;
    body.velocity.value = {0.9, 0.0, 0.0};
    const auto id = static_cast<BodyId>(scene.bodies.size());
    scene.bodies.push_back(body);
    World world = World::freeze(scene).value();
    for (int tick = 0; tick < 500; ++tick) world.tick();
    return world.position(id).value;
}

TEST(Everyday, AFloorOfTilesIsOneSlabForWhatSlidesAndRolls)
{
    BodyDescription cube = box(glm::dvec3{0.02}, {-0.01, 0.02, 0.003}); // on both rows
    BodyDescription beside = box(glm::dvec3{0.02}, {-0.01, 0.02, 0.043});
    BodyDescription locked = cube;
    locked.turning = Turning::locked;
    const BodyDescription round = ball(0.02, {-0.01, 0.02, 0.003});
    for (const Floor floor : {Floor::tiles, Floor::compound}) {
        for (const double friction : {0.0, 0.1}) {
            const auto miss = [&](const BodyDescription& body) {
                return glm::length(slid(floor, body, friction) - slid(Floor::slab, body, friction));
            };
            EXPECT_LE(miss(round), 1e-9) << friction;
            EXPECT_LE(miss(locked), 1e-9) << friction;
            EXPECT_LE(miss(beside), 1e-6) << friction;
            // The load of four tiles is solved to a millionth of the weight in each tick.
            EXPECT_LE(miss(cube), 1e-5) << friction;
        }
    }
}

TEST(Everyday, AHandFeelsNoSeamHoweverDeepItPresses)
{
    for (const Floor floor : {Floor::tiles, Floor::compound}) {
        for (const double depth : {0.001, 0.004, 0.006}) {
            Description scene = on_floor(floor, 0.0);
            scene.hands = {.stiffness_n_per_m = 400.0, .damping_ns_per_m = 0.0, .count = 1};
            scene.hands.force_max_n = HUGE_VAL;
            World world = World::freeze(scene).value();
            const double height = scene.hands.radius_m - depth;
            for (int tick = 0; tick < 3000; ++tick) {
                const glm::dvec3 at{1e-4 * tick, height, 0.0105};
                ASSERT_FALSE(world.set_hand(0, {.position = {at}, .velocity = {{0.1, 0.0, 0.0}}}));
                world.tick();
                const glm::dvec3 felt = world.touch(0).on_hand.value;
                ASSERT_NEAR(felt.y, 400.0 * depth, 1e-9) << tick;
                ASSERT_NEAR(felt.x, 0.0, 1e-9) << tick;
                ASSERT_NEAR(felt.z, 0.0, 1e-9) << tick;
            }
        }
    }
}

TEST(Everyday, AStepBetweenTilesStillStopsWhatSlides)
{
    Description scene = on_floor(Floor::tiles, 0.0);
    scene.bodies[4].position.value.y += 0.002; // the tiles from x = 0.12 m on
    scene.bodies[5].position.value.y += 0.002;
    BodyDescription cube = box(glm::dvec3{0.02}, {0.0, 0.02, 0.0});
    cube.velocity.value = {0.3, 0.0, 0.0};
    cube.turning = Turning::locked;
    const auto id = static_cast<BodyId>(scene.bodies.size());
    scene.bodies.push_back(cube);
    World world = World::freeze(scene).value();
    for (int tick = 0; tick < 1000; ++tick) world.tick();
    EXPECT_NEAR(world.position(id).x(), 0.12 - 0.02, 1e-6);
}

TEST(Everyday, AWallAloneIsFelt)
{
    Description scene;
    scene.hands = {.stiffness_n_per_m = 400.0, .damping_ns_per_m = 0.0, .count = 1};
    scene.bodies = {fixed(box(glm::dvec3{0.03}, {0.0, -0.03, 0.0}))};
    World world = World::freeze(scene).value();
    ASSERT_FALSE(world.set_hand(0, {.position = {{0.0, 0.003, 0.0}}}));
    world.tick();
    EXPECT_NEAR(world.touch(0).on_hand.y(), 400.0 * 0.002, 1e-12);
}

TEST(Everyday, APlateOnALongerCapsuleComesToRest)
{
    Description scene;
    scene.hands = {.stiffness_n_per_m = 300.0, .count = 1};
    BodyDescription pen = fixed(capsule(0.009, 0.07, {0.0, 0.009, 0.0}));
    BodyDescription plate = box({0.022, 0.003, 0.035}, {0.0, 0.022, 0.0});
    plate.mass_kg = 0.04;
    pen.material.friction = plate.material.friction = 0.5;
    scene.bodies = {pen, plate};
    for (const bool is_pressed : {false, true}) {
        World world = World::freeze(scene).value();
        double least = HUGE_VAL, most = 0.0;
        for (int tick = 0; tick < 3000; ++tick) {
            ASSERT_FALSE(
                world.set_hand(0, {.position = {{0.0, 0.0287, 0.02}}, .present = is_pressed}));
            world.tick();
            if (tick < 2000) continue;
            least = std::min(least, world.touch(0).on_hand.y());
            most = std::max(most, world.touch(0).on_hand.y());
        }
        EXPECT_LE(glm::length(world.body(1).angular_velocity), 1e-6);
        EXPECT_LE(most - least, 1e-6);
        if (!is_pressed) {
            EXPECT_NEAR(world.position(1).y(), 0.021, 1e-6);
        }
    }
}

TEST(Everyday, ACradlePassesOnAllOfItsEnergy)
{
    for (const double gap : {0.0, 1e-5, 1e-4, 4e-4}) {
        Description scene;
        scene.hands.count = 0;
        scene.gravity = glm::dvec3{0.0};
        constexpr double radius = 0.012;
        constexpr BodyId last = 5;
        for (int i = 0; i <= static_cast<int>(last); ++i)
            scene.bodies.push_back(ball(radius, {i * (2.0 * radius + gap), 0.0, 0.0}));
        scene.bodies.push_back(ball(radius, {-0.07, 0.0, 0.0}));
        scene.bodies.back().velocity.value.x = 0.8;
        for (BodyDescription& body : scene.bodies) body.material.restitution = 1.0;
        World world = World::freeze(scene).value();
        for (int tick = 0; tick < 400; ++tick) world.tick();
        for (BodyId id = 0; id < scene.bodies.size(); ++id)
            EXPECT_NEAR(world.velocity(id).x(), id == last ? 0.8 : 0.0, 1e-9) << gap << ' ' << id;
    }
}

TEST(Everyday, ElasticBodiesBounceForAMinuteAndKeepTheirEnergy)
{
    Description scene;
    scene.hands.count = 0;
    scene.planes = {{.name = "floor", .material = {.restitution = 1.0}}};
    BodyDescription tilted = box(glm::dvec3{0.015}, {0.6, 0.25, 0.0});
    tilted.orientation = glm::normalize(glm::dquat{0.95, 0.2, -0.1, 0.15});
    scene.bodies = {ball(0.015, {0.0, 0.25, 0.0}), box(glm::dvec3{0.015}, {0.3, 0.25, 0.0}),
                    tilted};
    for (BodyDescription& body : scene.bodies) body.material.restitution = 1.0;
    World world = World::freeze(scene).value();
    const auto energy = [&](BodyId id) {
        return test::kinetic_energy_of(scene.bodies[id], world.body(id)) +
               scene.bodies[id].mass_kg * weight_per_mass * world.position(id).y();
    };
    const std::array<double, 3> start{energy(0), energy(1), energy(2)};
    for (int tick = 0; tick < 60'000; ++tick) world.tick();
    for (const BodyId id : {0U, 1U, 2U}) EXPECT_NEAR(energy(id) / start[id], 1.0, 1e-6) << id;
}

TEST(Everyday, ABoxThatIsHardlyOffBalanceTips)
{
    Description scene;
    scene.hands.count = 0;
    const glm::dvec3 half{0.05, 0.014, 0.06};
    const double balance = std::atan2(half.z, half.y); // the centre over the lower edge
    const double lean = balance - 1e-4, radius = std::hypot(half.y, half.z);
    scene.planes = {{.name = "floor", .material = {.friction = 1.0}}};
    BodyDescription plank = box(half, {0.0, radius * std::cos(balance - lean), 0.0});
    plank.orientation = {std::cos(0.5 * lean), std::sin(0.5 * lean), 0.0, 0.0};
    plank.material.friction = 1.0;
    BodyDescription other = plank; // so that bodies may sleep
    other.position.value.x = 0.5;
    scene.bodies = {plank, other};
    World world = World::freeze(scene).value();
    for (int tick = 0; tick < 2000; ++tick) world.tick();
    EXPECT_NEAR(world.position(0).y(), half.y, 1e-4);
}

TEST(Everyday, AFreeBoxKeepsItsEnergyAtAnySpin)
{
    for (const double turn : {0.05, 0.3, 0.9, 2.5, 20.0}) { // radians in a tick
        Description scene;
        scene.hands.count = 0;
        scene.gravity = glm::dvec3{0.0};
        BodyDescription part = box({0.025, 0.012, 0.004}, {});
        part.angular_velocity = 1e3 * turn * glm::normalize(glm::dvec3{0.4, 0.7, 0.6});
        scene.bodies = {part};
        World world = World::freeze(scene).value();
        const double start = test::kinetic_energy_of(part, world.body(0));
        for (int tick = 0; tick < 3000; ++tick) world.tick();
        EXPECT_NEAR(test::kinetic_energy_of(part, world.body(0)) / start, 1.0, 1e-10) << turn;
    }
}

TEST(Everyday, ATinyBodyFarAwayChangesNothing)
{
    Description scene;
    scene.hands.count = 0;
    scene.planes = {{.name = "floor", .material = {.friction = 0.3}}};
    scene.bodies = {box(glm::dvec3{0.02}, {0.0, 0.02, 0.0}),
                    box(glm::dvec3{0.02}, {0.0, 0.05, 0.0})};
    const auto ticks_apart = [&] {
        World world = World::freeze(scene).value();
        int ticks = 0;
        for (; ticks < 2000; ++ticks) {
            if (world.position(1).y() - world.position(0).y() > 0.0398) break;
            world.tick();
        }
        return ticks;
    };
    const int alone = ticks_apart();
    scene.bodies.push_back(fixed(box(glm::dvec3{1.5e-4}, {2.0, 1.0, 0.0})));
    EXPECT_EQ(ticks_apart(), alone);
    scene.bodies.back().movable = true;
    scene.bodies.back().mass_kg = 1e-5;
    EXPECT_EQ(ticks_apart(), alone);
}

TEST(Everyday, ABodyThatIsLockedAboveAPlaneRubsOnItInEveryStepper)
{
    Description scene;
    scene.hands.count = 0;
    scene.planes = {{.name = "floor", .material = {.friction = 0.25}}};
    BodyDescription cube = box(glm::dvec3{0.02}, {0.0, 0.02, 0.0});
    cube.material.friction = 0.25;
    cube.velocity.value.x = 0.4;
    cube.turning = Turning::locked;
    cube.locked.y = true;
    scene.bodies = {cube};
    const double way = 0.4 * 0.4 / (2.0 * 0.25 * weight_per_mass);
    for (const StepperKind kind :
         {StepperKind::sliding_coulomb, StepperKind::lone, StepperKind::few, StepperKind::many}) {
        World world = World::freeze(scene, {.stepper = kind}).value();
        for (int tick = 0; tick < 1000; ++tick) world.tick();
        EXPECT_NEAR(world.position(0).x(), way, 1e-9) << name_of(kind);
    }
}

} // namespace
} // namespace everyday
} // namespace hapnet::scene
