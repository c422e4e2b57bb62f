// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/sweep.hpp"

#include "scene/collide/time_of_impact.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// Pairs that come nearer than this share of the smallest half edge within a tick are examined.
constexpr double look_ahead = 0.01;
// A body that moves farther than this share of the smallest half edge in a tick could pass through
// another.
constexpr double far_share = 0.5;

/// True if a box has turned by no more than rounding. A resting body that is pushed turns to and
/// fro by less. Otherwise its contacts would have to be found again in every tick.
bool is_as_good_as(const glm::dquat& kept, const glm::dquat& now)
{
    constexpr double rounding = 1e-13; // half of the turn
    return std::abs(now.w - kept.w) <= rounding && std::abs(now.x - kept.x) <= rounding &&
           std::abs(now.y - kept.y) <= rounding && std::abs(now.z - kept.z) <= rounding;
}

double shortest_half(const glm::dvec3& half) { return std::min(half.x, std::min(half.y, half.z)); }

} // namespace

OrientedBox box_of(const Bodies& bodies, Slot slot)
{
    return {bodies.position.at(slot), axes_of(bodies.orientation.at(slot)),
            bodies.properties[slot].half, bodies.properties[slot].rounding};
}

OrientedBox shape_of(const Bodies& bodies, PartId part)
{
    const Slot slot = bodies.slot_of[part];
    if (!bodies.properties[slot].has_parts()) return box_of(bodies, slot);
    const BodyPart& its = bodies.parts[part];
    const glm::dmat3 axes = axes_of(bodies.orientation.at(slot));
    return {bodies.position.at(slot) + axes * its.at, axes * its.axes, its.half, its.rounding};
}

SweptContact collide_swept(const BoxSweep& a, const BoxSweep& b, double tick, BoxBoxMemory& memory)
{
    const double margin = a.reach + b.reach;
    const double near = far_share * std::min(shortest_half(a.box.half), shortest_half(b.box.half));
    const glm::dvec3 velocity = b.velocity - a.velocity;
    // The bounding spheres suffice for most pairs that fly side by side.
    const glm::dvec3 apart = b.box.centre - a.box.centre;
    const double nearest =
        a.radius + b.radius + std::max(std::min(margin, near), tick * length(velocity));
    if (glm::dot(apart, apart) > nearest * nearest) return {};
    const ContactPlaces here{a.box.centre - a.offset, b.box.centre - b.offset};
    if (margin < near) return {collide(a.box, b.box, margin, memory), here};
    const auto impact = time_of_impact(a.box, b.box, velocity, tick);
    if (!impact)
        return {.manifold = collide(a.box, b.box, near, memory), .centres = here, .may_pass = true};
    OrientedBox there_a = a.box;
    OrientedBox there_b = b.box;
    there_a.centre += impact->time * a.velocity;
    there_b.centre += impact->time * b.velocity;
    Manifold manifold = collide(there_a, there_b, look_ahead * near, memory);
    for (ContactPoint& point : manifold.points) {
        point.separation -= impact->time * glm::dot(velocity, manifold.normal);
    }
    return {manifold, {there_a.centre - a.offset, there_b.centre - b.offset}, impact->time, true};
}

SweptBoxes::SweptBoxes(const Bodies& bodies, const Scales& scales)
    : scales_{scales}, entries_(bodies.parts_count())
{
    for (PartId part = 0; part < bodies.parts_count(); ++part) {
        const Slot slot = bodies.slot_of[part];
        Entry& entry = entries_[part];
        entry.now.box = shape_of(bodies, part);
        entry.now.radius = outer_radius(entry.now.box.half, entry.now.box.rounding);
        entry.now.orientation = bodies.orientation.at(slot);
        if (bodies.properties[slot].has_parts())
            entry.now.offset = axes_of(entry.now.orientation) * bodies.parts[part].at;
        renew(bodies, part, entry);
    }
}

void SweptBoxes::renew(const Bodies& bodies, PartId part, Entry& entry) const
{
    const Slot slot = bodies.slot_of[part];
    const bool has_parts = bodies.properties[slot].has_parts();
    SweptBox& now = entry.now;
    entry.seen = now_;
    now.box.centre = bodies.position.at(slot);
    now.spin = bodies.angular_velocity(slot);
    if (has_parts) now.box.centre += now.offset;
    const double arm = has_parts ? bodies.parts[part].radius : now.radius;
    const double turning = length(now.spin) * (arm - now.box.rounding);
    now.reach = scales_.tick * (length(bodies.velocity.at(slot)) + turning + scales_.fall) +
                look_ahead * shortest_half(now.box.half);
    const glm::dquat orientation = bodies.orientation.at(slot);
    if (is_as_good_as(now.orientation, orientation)) return;
    now.orientation = orientation;
    now.box.axes = axes_of(orientation);
    ++now.turns;
    if (!has_parts) return;
    now.offset = now.box.axes * bodies.parts[part].at;
    now.box.centre = bodies.position.at(slot) + now.offset;
    now.box.axes = now.box.axes * bodies.parts[part].axes;
}

void SweptBoxes::forget(const Bodies& bodies, BodyId body)
{
    bodies.for_parts(body, [&](PartId part) {
        entries_[part].seen = 0;
        entries_[part].now.orientation = {0.0, 0.0, 0.0, 0.0}; // equal to no orientation
    });
}

} // namespace hapnet::scene
