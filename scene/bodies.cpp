// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/bodies.hpp"

#include "proto/base/ensure.hpp"
#include "scene/collide/manifold.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

namespace hapnet::scene {

namespace {

int free_axis(Turning turning)
{
    return static_cast<int>(turning) - static_cast<int>(Turning::about_x);
}

/// Returns the inertia in the world's frame of a body that turns only about one of the world's
/// axes. Rotation does not change it.
double inertia_about(int axis, const glm::dvec3& inertia, const glm::dquat& orientation)
{
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    double about = 0.0;
    for (const int own : {0, 1, 2}) about += axes[own][axis] * axes[own][axis] * inertia[own];
    return about;
}

BodyProperties properties_of(const BodyDescription& body, BodyId id)
{
    BodyProperties properties{.id = id, .half = body.half, .rounding = rounding_of(body)};
    properties.least_half = std::min({body.half.x, body.half.y, body.half.z});
    properties.material = body.material;
    properties.drag = body.drag_ns_per_m;
    if (body.kinematic) {
        // A unit inertia that nothing changes: angular velocity and momentum are the same numbers.
        properties.is_kinematic = properties.is_isotropic = true;
        properties.turning = Turning::free;
        properties.inverse_inertia = glm::dvec3{1.0};
    }
    if (!body.movable) return properties;
    properties.mass = body.mass_kg;
    properties.turning = body.turning;
    const double light = 1.0 / body.mass_kg;
    properties.inverse_mass = {body.locked.x ? 0.0 : light, body.locked.y ? 0.0 : light,
                               body.locked.z ? 0.0 : light};
    properties.inertia = inertia_of(body);
    properties.is_isotropic =
        body.parts.empty() && body.half.x == body.half.y && body.half.y == body.half.z;
    if (body.turning == Turning::free) {
        properties.inverse_inertia = 1.0 / properties.inertia;
    } else if (body.turning != Turning::locked) {
        const int axis = free_axis(body.turning);
        properties.inverse_inertia[axis] =
            1.0 / inertia_about(axis, properties.inertia,
                                base::normalized(frame_of_mass(body).orientation));
    }
    return properties;
}

template <typename Lanes>
void swap_lanes(Lanes& lanes, Slot a, Slot b)
{
    std::swap(lanes.x[a], lanes.x[b]);
    std::swap(lanes.y[a], lanes.y[b]);
    std::swap(lanes.z[a], lanes.z[b]);
}

} // namespace

Bodies::Bodies(const Description& description)
{
    const auto& bodies = description.bodies;
    const std::size_t count = bodies.size();
    for (Lanes3* lanes : {&position, &velocity, &angular_momentum}) {
        for (auto* lane : {&lanes->x, &lanes->y, &lanes->z}) lane->resize(count);
    }
    for (auto* lane : {&orientation.w, &orientation.x, &orientation.y, &orientation.z}) {
        lane->resize(count);
    }
    slot_of.resize(count);
    properties.reserve(count);
    inverse_inertia_max.reserve(count);
    enum class Range : std::uint8_t { pushed, driven, fixed };
    const auto range_of = [](const BodyDescription& body) {
        return body.movable ? Range::pushed : body.kinematic ? Range::driven : Range::fixed;
    };
    for (const Range range : {Range::pushed, Range::driven, Range::fixed}) {
        for (BodyId id = 0; id < count; ++id) {
            if (range_of(bodies[id]) != range) continue;
            slot_of[id] = size();
            properties.push_back(properties_of(bodies[id], id));
            const glm::dvec3& easy = properties.back().inverse_inertia;
            inverse_inertia_max.push_back(std::max({easy.x, easy.y, easy.z}));
        }
        if (range == Range::pushed) awake = movable = size();
        if (range == Range::driven) moving = size();
    }
    add_parts(description);
    for (BodyId id = 0; id < count; ++id) {
        const BodyDescription& body = bodies[id];
        const Slot slot = slot_of[id];
        const MassFrame frame = frame_of_mass(body);
        orientation.put(slot, base::normalized(frame.orientation));
        position.put(slot, frame.centre.value);
        if (!body.movable && !body.kinematic) continue;
        put(slot, {frame.centre, orientation.at(slot), body.velocity, body.angular_velocity});
    }
}

/// Adds the further parts of bodies of several parts, after the first parts of all bodies.
void Bodies::add_parts(const Description& description)
{
    const auto& bodies = description.bodies;
    const auto has_parts = [](const BodyDescription& body) { return !body.parts.empty(); };
    if (std::none_of(bodies.begin(), bodies.end(), has_parts)) return;
    parts.resize(size());
    for (BodyId id = 0; id < bodies.size(); ++id) {
        const Slot slot = slot_of[id];
        BodyProperties& its = properties[slot];
        if (!has_parts(bodies[id])) {
            parts[id] = {.half = its.half, .rounding = its.rounding};
            parts[id].radius = outer_radius(its.half, its.rounding);
            continue;
        }
        const std::vector<BodyPart> all = parts_of(bodies[id]);
        its.half = half_around(all);
        for (const BodyPart& part : all)
            its.least_half = std::min({its.least_half, part.half.x, part.half.y, part.half.z});
        its.rounding = 0.0;
        its.parts_begin = parts_count();
        parts[id] = all.front();
        parts.insert(parts.end(), all.begin() + 1, all.end());
        slot_of.resize(parts.size(), slot);
        its.parts_end = parts_count();
    }
}

bool Bodies::any_is_round() const
{
    return std::any_of(properties.begin(), properties.end(),
                       [](const BodyProperties& body) { return body.rounding > 0.0; }) ||
           std::any_of(parts.begin(), parts.end(),
                       [](const BodyPart& part) { return part.rounding > 0.0; });
}

void Bodies::swap(Slot a, Slot b)
{
    if (a == b) return;
    swap_lanes(position, a, b);
    swap_lanes(velocity, a, b);
    swap_lanes(orientation, a, b);
    std::swap(orientation.w[a], orientation.w[b]);
    swap_lanes(angular_momentum, a, b);
    std::swap(inverse_inertia_max[a], inverse_inertia_max[b]);
    std::swap(properties[a], properties[b]);
    for (const Slot slot : {a, b}) {
        slot_of[properties[slot].id] = slot;
        for (PartId part = properties[slot].parts_begin; part < properties[slot].parts_end; ++part)
            slot_of[part] = slot;
    }
}

Slot Bodies::put_to_sleep(Slot slot)
{
    base::ensure(slot < awake);
    --awake;
    swap(slot, awake);
    return awake;
}

Slot Bodies::wake(Slot slot)
{
    base::ensure(slot >= awake && slot < movable);
    swap(slot, awake);
    return awake++;
}

glm::dvec3 Bodies::turned_inverse_inertia(const BodyProperties& body, const glm::dquat& orientation,
                                          const glm::dvec3& momentum)
{
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    return axes * (body.inverse_inertia * (momentum * axes));
}

double Bodies::kinetic_energy(Slot slot) const
{
    const glm::dvec3 v = velocity.at(slot);
    return 0.5 * (properties[slot].mass * glm::dot(v, v) +
                  glm::dot(angular_momentum.at(slot), angular_velocity(slot)));
}

glm::dvec3 Bodies::apply_inertia(const BodyProperties& body, const glm::dquat& orientation,
                                 const glm::dvec3& angular_velocity)
{
    glm::dvec3 momentum{0.0};
    if (body.turning == Turning::free) {
        const glm::dmat3 axes = glm::mat3_cast(orientation);
        momentum = body.is_isotropic ? body.inertia * angular_velocity
                                     : axes * (body.inertia * (angular_velocity * axes));
    } else if (body.turning != Turning::locked) {
        const int axis = free_axis(body.turning);
        momentum[axis] = angular_velocity[axis] / body.inverse_inertia[axis];
    }
    return momentum;
}

void Bodies::set_angular_velocity(Slot slot, const glm::dvec3& angular_velocity)
{
    angular_momentum.put(slot,
                         apply_inertia(properties[slot], orientation.at(slot), angular_velocity));
}

BodyState Bodies::state(Slot slot) const
{
    return {{position.at(slot)}, orientation.at(slot), {velocity.at(slot)}, angular_velocity(slot)};
}

void Bodies::put(Slot slot, const BodyState& state)
{
    const glm::dvec3& light = properties[slot].inverse_mass;
    glm::dvec3 speed = state.velocity.value;
    for (const int axis : {0, 1, 2}) {
        if (light[axis] == 0.0 && !properties[slot].is_kinematic) speed[axis] = 0.0;
    }
    position.put(slot, state.position.value);
    orientation.put(slot, state.orientation);
    velocity.put(slot, speed);
    set_angular_velocity(slot, state.angular_velocity);
}

} // namespace hapnet::scene
