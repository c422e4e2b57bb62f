// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"
#include "scene/maths/vector.hpp"
#include "scene/world.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

inline constexpr double half = 0.02;
inline constexpr double gravity = 9.81;
inline constexpr double friction = 0.3;

inline BodyDescription cube_at(const glm::dvec3& place, double mass_kg = 0.1)
{
    BodyDescription cube{
        .name = "cube", .half = glm::dvec3{half}, .position = {place}, .mass_kg = mass_kg};
    cube.material.friction = friction;
    return cube;
}

/// A platform at y = 0 without hands.
inline Description platform()
{
    Description scene;
    scene.hands.count = 0;
    scene.planes.push_back({.name = "platform", .material = {.friction = friction}});
    return scene;
}

inline World world_of(const Description& scene, base::Duration tick = std::chrono::milliseconds{1})
{
    auto world = World::freeze(scene, {.tick = tick, .sleeping = false});
    base::ensure(world.has_value());
    return *std::move(world);
}

inline void run(World& world, std::uint64_t ticks)
{
    for (std::uint64_t i = 0; i < ticks; ++i) world.tick();
}

/// Returns the rotation from its upright start, radians (small angles).
inline double rotated(const BodyState& state)
{
    const glm::dquat& q = state.orientation;
    return 2.0 * std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
}

inline double energy(const World& world)
{
    const Bodies& bodies = world.state().bodies;
    double sum = 0.0;
    for (Slot slot = 0; slot < bodies.movable; ++slot) {
        const glm::dvec3 v = bodies.velocity.at(slot);
        sum += 0.5 * bodies.properties[slot].mass * glm::dot(v, v);
        sum += 0.5 * glm::dot(bodies.angular_velocity(slot), bodies.angular_momentum.at(slot));
        sum -= bodies.properties[slot].mass *
               glm::dot(world.frozen().gravity, bodies.position.at(slot));
    }
    return sum;
}

/// Cubes in a stack.
inline Description stack_of(std::size_t cubes)
{
    Description scene = platform();
    for (std::size_t i = 0; i < cubes; ++i) {
        scene.bodies.push_back(cube_at({0.0, half * (1.0 + 2.0 * static_cast<double>(i)), 0.0}));
    }
    return scene;
}

/// Returns the largest distance of a body from its place in the description.
inline double drift(const World& world, const Description& scene)
{
    double most = 0.0;
    for (BodyId id = 0; id < scene.bodies.size(); ++id) {
        most =
            std::max(most, length(world.body(id).position.value - scene.bodies[id].position.value));
    }
    return most;
}

} // namespace hapnet::scene
