// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/fields.hpp"

#include "proto/base/math.hpp"
#include "scene/rigid/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// True if a place is in the field's region.
bool is_in_region(const FieldDescription& field, const glm::dvec3& place)
{
    if (!field.half) return true;
    const glm::dvec3 off = glm::abs(place - field.position.value) - *field.half;
    return off.x <= 0.0 && off.y <= 0.0 && off.z <= 0.0;
}

/// Returns the part of a vector across the field's line, or the whole vector if the spring pulls to
/// a point.
glm::dvec3 across(const FieldDescription& field, const glm::dvec3& v)
{
    return field.line ? v - glm::dot(v, *field.line) * *field.line : v;
}

glm::dvec3 limited(const FieldDescription& field, const glm::dvec3& force)
{
    return base::limited(base::Force{force}, std::min(field.force_limit_n, force_max_n)).value;
}

/// Returns the force at one moment.
glm::dvec3 force_at(const FieldDescription& field, const glm::dvec3& place,
                    const glm::dvec3& velocity)
{
    const glm::dvec3 offset = across(field, place - field.position.value);
    return limited(field, field.force.value - field.damping_ns_per_m * velocity -
                              field.stiffness_n_per_m * offset);
}

} // namespace

glm::dvec3 force_on_body(const FieldDescription& field, const WorldConfig& config,
                         const Bodies& bodies, Slot slot)
{
    const glm::dvec3 place = bodies.position.at(slot);
    if (!field.on_bodies || !is_in_region(field, place)) return glm::dvec3{0.0};
    const double tick = config.tick;
    const double half = 0.5 * tick;
    const BodyProperties& body = bodies.properties[slot];
    // With this damping of the velocity halfway, the tick reduces the velocity by the factor of the
    // exponential law.
    const double keeps = base::exp(-field.damping_ns_per_m * tick / body.mass);
    const double damping = (1.0 - keeps) / (1.0 + keeps) * body.mass / half;
    // The velocity and offset halfway, without the field's force. Each newton of the force moves
    // the body so that the force becomes smaller by `ease` newtons.
    const glm::dvec3 fall = half * gravity_on(body, config.gravity);
    const glm::dvec3 velocity = bodies.velocity.at(slot) + fall;
    const glm::dvec3 offset = place - field.position.value + half * velocity;
    const double ease = damping * half / body.mass;
    const double ease_across = ease + field.stiffness_n_per_m * half * half / body.mass;
    const glm::dvec3 wanted = field.force.value - damping * velocity;
    const glm::dvec3 wanted_across = across(field, wanted);
    const glm::dvec3 pull = field.stiffness_n_per_m * across(field, offset);
    return limited(field, (wanted - wanted_across) / (1.0 + ease) +
                              (wanted_across - pull) / (1.0 + ease_across));
}

void feel_fields(const WorldConfig& config, WorldState& state)
{
    for (std::uint32_t hand = 0; hand < config.hands.count; ++hand) {
        const HandInput& input = state.hands[hand];
        if (!input.present) continue;
        const glm::dvec3& place = input.position.value;
        const glm::dvec3& velocity = input.velocity.value;
        for (const FieldDescription& field : config.fields) {
            if (!field.on_hands || !is_in_region(field, place)) continue;
            HandTouch& touch = state.touches[hand];
            touch.on_hand.value += force_at(field, place + 0.5 * config.tick * velocity, velocity);
            touch.on_hand_at_start.value += force_at(field, place, velocity);
        }
    }
}

} // namespace hapnet::scene
