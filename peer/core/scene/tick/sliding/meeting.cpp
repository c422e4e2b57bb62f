// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/sliding/meeting.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

EnteredFace face_at(std::size_t axis, double place)
{
    return {static_cast<std::uint8_t>(axis), static_cast<std::int8_t>(place < 0.0 ? -1 : 1)};
}

Meeting at_face(const Approach& hand, const PerAxis& half, EnteredFace face)
{
    Meeting meeting{.axis = face.axis};
    meeting.normal[face.axis] = face.sign;
    meeting.depth = hand.radius + half[face.axis] - face.sign * hand.from_centre[face.axis];
    return meeting;
}

EnteredFace nearest_face(const PerAxis& place, const PerAxis& half)
{
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        if (half[i] - std::abs(place[i]) < half[nearest] - std::abs(place[nearest])) nearest = i;
    }
    return face_at(nearest, place[nearest]);
}

/// The vector to a place from the closest point of the box.
struct Outside {
    PerAxis away{};
    std::size_t axis = 0;       // along which it is longest
    std::size_t directions = 0; // that take part: 0 inside, 1 before a face

    Outside(const PerAxis& place, const PerAxis& half)
    {
        for (std::size_t i = 0; i < 3; ++i) {
            const double beyond = std::abs(place[i]) - half[i];
            if (!(beyond > 0.0)) continue;
            away[i] = place[i] < 0.0 ? -beyond : beyond;
            if (directions == 0 || beyond > std::abs(away[axis])) axis = i;
            ++directions;
        }
    }
    [[nodiscard]] bool is_along(std::size_t i) const
    {
        return directions == 0 || (directions == 1 && axis == i);
    }
    [[nodiscard]] double length() const
    {
        return directions == 1 ? std::abs(away[axis]) : std::sqrt(dot(away, away));
    }
    [[nodiscard]] PerAxis direction() const
    {
        const double distance = length();
        return {away[0] / distance, away[1] / distance, away[2] / distance};
    }
};

/// When and through which face of the box grown by the radius the hand comes in.
struct Arrival {
    double time = 0.0;
    std::size_t axis = no_axis; // none: it is inside of the grown box from the start
};

std::optional<Arrival> arrival(const Approach& hand, const PerAxis& half)
{
    Arrival found;
    for (std::size_t i = 0; i < 3; ++i) {
        const double gap = std::abs(hand.from_centre[i]) - half[i] - hand.radius;
        if (gap < 0.0) continue;
        const double closing = hand.from_centre[i] < 0.0 ? hand.velocity[i] : -hand.velocity[i];
        if (!(closing * hand.tick > gap)) return std::nullopt;
        const double time = gap / closing;
        if (found.axis == no_axis || time > found.time) found = {time, i};
    }
    return found;
}

PerAxis place_after(const Approach& hand, double time)
{
    PerAxis place = hand.from_centre;
    for (std::size_t i = 0; i < 3; ++i) place[i] += time * hand.velocity[i];
    return place;
}

/// A hand that is apart and outside.
std::optional<Meeting> approaching(const Approach& hand, const PerAxis& half, EnteredFace& entered)
{
    const Outside out{hand.from_centre, half};
    const auto found = arrival(hand, half);
    if (!found) { // the box may still come to it
        if (out.directions > 1) return std::nullopt;
        return at_face(hand, half, face_at(out.axis, hand.from_centre[out.axis]));
    }
    const std::size_t axis = found->axis == no_axis ? out.axis : found->axis;
    const EnteredFace face = face_at(axis, hand.from_centre[axis]);
    if (Outside{place_after(hand, found->time), half}.is_along(axis)) {
        entered = face;
        return at_face(hand, half, face);
    }
    // Towards an edge or a corner: the closest point at the end of the tick gives the normal.
    const PerAxis last = place_after(hand, hand.tick);
    const Outside end{last, half};
    if (end.length() >= hand.radius) return std::nullopt;
    entered = face;
    if (end.is_along(axis)) return at_face(hand, half, face);
    Meeting meeting{.normal = end.direction(), .depth = hand.radius};
    for (std::size_t i = 0; i < 3; ++i) {
        meeting.depth -= meeting.normal[i] * (hand.from_centre[i] - (last[i] - end.away[i]));
    }
    return meeting;
}

} // namespace

std::optional<Meeting> meet(const Approach& hand, const PerAxis& half, EnteredFace& entered)
{
    const Outside out{hand.from_centre, half};
    if (out.directions == 0) {
        if (entered.axis == no_axis) entered = nearest_face(hand.from_centre, half);
        return at_face(hand, half, entered);
    }
    const double distance = out.length();
    if (distance >= hand.radius) {
        entered = {};
        return approaching(hand, half, entered);
    }
    entered = face_at(out.axis, hand.from_centre[out.axis]);
    if (out.directions == 1) return at_face(hand, half, entered);
    return Meeting{.normal = out.direction(), .depth = hand.radius - distance};
}

} // namespace hapnet::scene
