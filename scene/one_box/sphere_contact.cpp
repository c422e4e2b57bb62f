// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/sphere_contact.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

/// The time and the face at which the hand enters the box grown by the radius.
struct Entry {
    double time = 0.0;
    std::size_t axis = no_axis; // no_axis: the hand is inside the grown box from the start
};

std::optional<Entry> entry_into_grown_box(const SphereMotion& hand, const PerAxis& half)
{
    Entry found;
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

PerAxis place_after(const SphereMotion& hand, double time)
{
    PerAxis place = hand.from_centre;
    for (std::size_t i = 0; i < 3; ++i) place[i] += time * hand.velocity[i];
    return place;
}

/// Finds the first contact of a hand that is apart and outside.
std::optional<SphereContact> first_contact(const SphereMotion& hand, const PerAxis& half,
                                           BoxFace& entered)
{
    const OutsideVector out{hand.from_centre, half};
    const auto found = entry_into_grown_box(hand, half);
    if (!found) { // the box may still reach the hand
        if (out.directions > 1) return std::nullopt;
        return contact_at_face(hand.from_centre, half, out.face(), hand.radius);
    }
    const std::size_t axis = found->axis == no_axis ? out.axis : found->axis;
    const BoxFace face = face_at(axis, hand.from_centre[axis]);
    if (OutsideVector{place_after(hand, found->time), half}.is_along(axis)) {
        entered = face;
        return contact_at_face(hand.from_centre, half, face, hand.radius);
    }
    // Towards an edge or a corner: the closest point at the end of the tick gives the normal.
    const PerAxis last = place_after(hand, hand.tick);
    const OutsideVector end{last, half};
    if (end.length() >= hand.radius) return std::nullopt;
    entered = face;
    if (end.is_along(axis)) return contact_at_face(hand.from_centre, half, face, hand.radius);
    SphereContact contact{.face = {}, .depth = hand.radius, .edge_normal = end.direction()};
    for (std::size_t i = 0; i < 3; ++i) {
        contact.depth -= contact.edge_normal[i] * (hand.from_centre[i] - (last[i] - end.away[i]));
    }
    return contact;
}

} // namespace

std::optional<SphereContact> collide_sphere(const SphereMotion& hand, const PerAxis& half,
                                            BoxFace& entered)
{
    const OutsideVector out{hand.from_centre, half};
    if (out.directions == 0) {
        if (entered.axis == no_axis) entered = nearest_face(hand.from_centre, half);
        return contact_at_face(hand.from_centre, half, entered, hand.radius);
    }
    const double distance = out.length();
    if (distance >= hand.radius) {
        entered = {};
        return first_contact(hand, half, entered);
    }
    entered = out.face();
    if (out.directions == 1) return contact_at_face(hand.from_centre, half, entered, hand.radius);
    return SphereContact{{}, hand.radius - distance, out.direction()};
}

} // namespace hapnet::scene
