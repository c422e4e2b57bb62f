// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/world.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

TEST(RigidStepper, ACubeThatTipsOverAnEdgeThatSticksKeepsTheEdgeWhereItIs)
{
    const double radius = 0.02 * std::sqrt(2.0); // from the edge to the centre, right above it
    constexpr double rotated = 0.7853981633974483;
    constexpr double speed = 0.5;
    BodyDescription cube;
    cube.orientation = {std::cos(rotated / 2.0), 0.0, 0.0, std::sin(rotated / 2.0)};
    cube.position = {{0.0, radius, 0.0}};
    cube.velocity = {{speed * radius, 0.0, 0.0}};
    cube.angular_velocity = {0.0, 0.0, -speed};
    cube.material.friction = 2.0;
    Description scene;
    scene.bodies = {cube};
    scene.planes = {{.name = "floor", .material = {.friction = 2.0}}};
    scene.hands.count = 0;
    World world = World::freeze(scene).value();
    for (int i = 0; i < 64; ++i) world.tick();
    const BodyState state = world.body(0);
    const double tipped = rotated - 2.0 * std::atan2(state.orientation.z, state.orientation.w);
    EXPECT_GT(tipped, 0.03);
    EXPECT_NEAR(state.position.x() - radius * std::sin(tipped), 0.0, 1e-8);
}

TEST(RigidStepper, DragActsFromTheFirstTickOnWhatIsPutOnAPlane)
{
    Description scene = paper_scene();
    scene.bodies.resize(1);
    scene.bodies[0].turning = Turning::free;
    scene.bodies[0].locked = {};
    scene.bodies[0].velocity = {{0.2, 0.0, 0.0}};
    scene.hands.count = 0;
    World world = World::freeze(scene, {.sleeping = false}).value(); // sleep would stop it
    for (int i = 0; i < 500; ++i) world.tick(); // 50 time constants of 0.1 kg / (10 N s/m)
    EXPECT_NEAR(world.body(0).position.x(), 0.2 * 0.01, 1e-14);
}

/// At any moment of the hit in a tick, the speed of the bounce decreases by drag from then on.
TEST(RigidStepper, DragTakesItsPartOfABounceWithinTheTick)
{
    Description scene = paper_scene();
    scene.bodies.resize(1);
    scene.bodies[0].turning = Turning::free;
    scene.bodies[0].locked = {};
    constexpr double speed = 0.2, restitution = 0.5;
    scene.bodies[0].velocity = {{speed, 0.0, 0.0}};
    scene.hands.count = 0;
    const double rate = scene.bodies[0].drag_ns_per_m / scene.bodies[0].mass_kg;
    constexpr double tick = 1e-3;
    for (const double when : {0.05, 0.3, 0.6, 0.95}) {
        Description walled = scene;
        const double wall = walled.bodies[0].position.x() + walled.bodies[0].half.x +
                            speed * (1.0 - std::exp(-rate * when * tick)) / rate;
        walled.planes.push_back({"wall", {-1.0, 0.0, 0.0}, -wall, {.restitution = restitution}});
        World world = World::freeze(walled).value();
        world.tick();
        const double end = -restitution * speed * std::exp(-rate * tick);
        // An even decrease of the speed until the touch has an error of second order.
        EXPECT_NEAR(world.body(0).velocity.x(), end, 0.5 * rate * rate * tick * tick * speed);
    }
}

} // namespace
} // namespace hapnet::scene
