// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/settle.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// The energy of a spring; beyond its greatest force it grows evenly.
double energy(const HandSpring& spring, double depth)
{
    if (depth <= 0.0) return 0.0;
    const double bend = spring.force_max / spring.stiffness;
    if (depth <= bend) return 0.5 * spring.stiffness * depth * depth;
    return spring.force_max * (depth - 0.5 * bend);
}

/// How much of an impulse a spring can give besides what it gave: not more together than `most`.
double share_within(const glm::dvec3& given, const glm::dvec3& more, double most)
{
    if (std::isinf(most)) return 1.0;
    const double square = glm::dot(more, more);
    const double along = glm::dot(given, more);
    const double room = most * most - glm::dot(given, given);
    if (square + 2.0 * along <= room) return 1.0;
    if (room <= 0.0) return 0.0;
    return (std::sqrt(along * along + square * room) - along) / square;
}

/// The mass of a body along each axis; 0 where it is locked.
glm::dvec3 mass_of(const BodyDynamics& dynamics)
{
    const glm::dvec3& light = dynamics.inverse_mass;
    const double most = std::max(std::max(light.x, light.y), light.z);
    const double mass = most > 0.0 ? 1.0 / most : 0.0;
    return {light.x > 0.0 ? mass : 0.0, light.y > 0.0 ? mass : 0.0, light.z > 0.0 ? mass : 0.0};
}

} // namespace

void correct_energy(const EnergyCorrection& settling, const HandSpring& spring,
                    const SpringDepths& depths, SpringImpulse& work)
{
    MovingBody& body = settling.body;
    const double missed = energy(spring, depths.true_m) - energy(spring, depths.followed);
    const glm::dvec3 velocity = body.velocity - spring.velocity;
    const glm::dvec3 momentum = mass_of(settling.dynamics) * velocity;
    const double twice =
        glm::dot(momentum, velocity) +
        glm::dot(body.angular_momentum, settling.inverse_inertia * body.angular_momentum);
    constexpr double most = 0.03; // more cannot come from a geometry that is a little off
    if (!(twice > 0.0)) return;
    double scale = std::clamp(-missed / twice, -most, most);
    scale *= share_within(work.impulse, scale * momentum, spring.force_max * settling.tick);
    body.velocity += scale * (settling.dynamics.inverse_mass * momentum);
    body.angular_momentum *= 1.0 + scale;
    work.impulse += scale * momentum;
}

} // namespace hapnet::scene
