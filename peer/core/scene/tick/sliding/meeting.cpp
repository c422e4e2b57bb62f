// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/sliding/meeting.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

double sign_of(double value) { return value < 0.0 ? -1.0 : 1.0; }

EnteredFace face_at(int axis, double place)
{
    return {static_cast<std::int8_t>(axis), static_cast<std::int8_t>(place < 0.0 ? -1 : 1)};
}

Meeting at_face(const Approach& hand, const glm::dvec3& half, EnteredFace face)
{
    Meeting meeting{.axis = face.axis};
    meeting.normal[face.axis] = face.sign;
    meeting.depth = hand.radius + half[face.axis] - face.sign * hand.from_centre[face.axis];
    return meeting;
}

EnteredFace nearest_face(const glm::dvec3& place, const glm::dvec3& half)
{
    int nearest = 0;
    for (const int i : {1, 2}) {
        if (half[i] - std::abs(place[i]) < half[nearest] - std::abs(place[nearest])) nearest = i;
    }
    return face_at(nearest, place[nearest]);
}

/// The vector from the closest point of the box.
glm::dvec3 outside(const glm::dvec3& place, const glm::dvec3& half)
{
    glm::dvec3 out{0.0};
    for (const int i : {0, 1, 2}) {
        if (place[i] > half[i]) out[i] = place[i] - half[i];
        if (place[i] < -half[i]) out[i] = place[i] + half[i];
    }
    return out;
}

int largest(const glm::dvec3& v)
{
    int axis = 0;
    for (const int i : {1, 2}) {
        if (std::abs(v[i]) > std::abs(v[axis])) axis = i;
    }
    return axis;
}

bool is_along(const glm::dvec3& v, int axis)
{
    return v[(axis + 1) % 3] == 0.0 && v[(axis + 2) % 3] == 0.0;
}

double length(const glm::dvec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// When and through which face of the box grown by the radius the hand comes in.
struct Arrival {
    double time = 0.0;
    int axis = -1; // -1: it is inside of the grown box from the start
};

std::optional<Arrival> arrival(const Approach& hand, const glm::dvec3& half)
{
    Arrival found;
    for (const int i : {0, 1, 2}) {
        const double gap = std::abs(hand.from_centre[i]) - half[i] - hand.radius;
        if (gap < 0.0) continue;
        const double closing = -sign_of(hand.from_centre[i]) * hand.velocity[i];
        if (!(closing * hand.tick > gap)) return std::nullopt;
        const double time = gap / closing;
        if (found.axis < 0 || time > found.time) found = {time, i};
    }
    return found;
}

/// A hand that is apart and outside.
std::optional<Meeting> approaching(const Approach& hand, const glm::dvec3& half,
                                   EnteredFace& entered)
{
    const glm::dvec3 out = outside(hand.from_centre, half);
    const int facing = largest(out);
    const auto found = arrival(hand, half);
    if (!found) { // the box may still come to it
        if (!is_along(out, facing)) return std::nullopt;
        return at_face(hand, half, face_at(facing, hand.from_centre[facing]));
    }
    const int axis = found->axis < 0 ? facing : found->axis;
    const EnteredFace face = face_at(axis, hand.from_centre[axis]);
    const glm::dvec3 there = outside(hand.from_centre + found->time * hand.velocity, half);
    if (is_along(there, axis)) {
        entered = face;
        return at_face(hand, half, face);
    }
    // Towards an edge or a corner: the closest point at the end of the tick gives the normal.
    const glm::dvec3 last = hand.from_centre + hand.tick * hand.velocity;
    const glm::dvec3 end = outside(last, half);
    const double distance = length(end);
    if (distance >= hand.radius) return std::nullopt;
    entered = face;
    if (distance == 0.0 || is_along(end, axis)) return at_face(hand, half, face);
    Meeting meeting{.normal = end / distance};
    const glm::dvec3 from_point = hand.from_centre - (last - end);
    meeting.depth =
        hand.radius - (meeting.normal.x * from_point.x + meeting.normal.y * from_point.y +
                       meeting.normal.z * from_point.z);
    return meeting;
}

} // namespace

std::optional<Meeting> meet(const Approach& hand, const glm::dvec3& half, EnteredFace& entered)
{
    const glm::dvec3 out = outside(hand.from_centre, half);
    const int facing = largest(out);
    if (out[facing] == 0.0) {
        if (entered.axis < 0) entered = nearest_face(hand.from_centre, half);
        return at_face(hand, half, entered);
    }
    const bool is_straight = is_along(out, facing);
    const double distance = is_straight ? std::abs(out[facing]) : length(out);
    if (distance >= hand.radius) {
        entered = {};
        return approaching(hand, half, entered);
    }
    entered = face_at(facing, hand.from_centre[facing]);
    if (is_straight) return at_face(hand, half, entered);
    return Meeting{.normal = out / distance, .depth = hand.radius - distance};
}

} // namespace hapnet::scene
