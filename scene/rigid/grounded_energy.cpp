// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/grounded_energy.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

void GroundedEnergy::begin(const WorldState& state, ContactSolver& solver) const
{
    for (const Slot slot : active.slots()) {
        integrations[slot + 1].is_grounded = false;
        integrations[slot + 1].meets_another = false;
    }
    for (const ContactBlock& block : solver.blocks()) {
        if (block.a == 0 || block.b == 0)
            integrations[block.a + block.b].is_grounded = true;
        else
            integrations[block.a].meets_another = integrations[block.b].meets_another = true;
    }
    for (const Slot slot : active.slots()) {
        BodyIntegration& integration = integrations[slot + 1];
        if (integration.meets_another || integration.has_hands || integration.is_joined ||
            state.torques[bodies.properties[slot].id] != glm::dvec3{0.0})
            integration.is_grounded = false;
        if (!integration.is_grounded) continue;
        integration.start_position = bodies.position.at(slot);
        integration.start_energy = bodies.kinetic_energy(slot);
    }
}

void GroundedEnergy::leave_pushed(const ContinuousCollision& touches) const
{
    touches.for_pushes(bodies, [&](Slot a, Slot b) {
        for (const Slot slot : {a, b})
            if (active.contains(slot)) integrations[slot + 1].is_grounded = false;
    });
    touches.for_changed(bodies, [&](Slot slot) {
        if (active.contains(slot) && touches.beginning(slot).driven.speed > 0.0)
            integrations[slot + 1].is_grounded = false;
    });
}

void GroundedEnergy::settle(const WorldState& state) const
{
    constexpr double rounding = 1e-14; // of what is there
    for (const Slot slot : active.slots()) {
        const BodyIntegration& integration = integrations[slot + 1];
        if (!integration.is_grounded) continue;
        const BodyProperties& properties = bodies.properties[slot];
        const glm::dvec3 load =
            properties.mass * gravity_on(properties, config.gravity) + state.pushes[properties.id];
        const double work = glm::dot(load, bodies.position.at(slot) - integration.start_position);
        const double now = bodies.kinetic_energy(slot);
        const double gain = now - integration.start_energy - work;
        if (gain <= rounding * (now + std::abs(work))) continue;
        const double share = std::sqrt(std::max(0.0, 1.0 - gain / now));
        bodies.velocity.put(slot, share * bodies.velocity.at(slot));
        bodies.angular_momentum.put(slot, share * bodies.angular_momentum.at(slot));
    }
}

} // namespace hapnet::scene
