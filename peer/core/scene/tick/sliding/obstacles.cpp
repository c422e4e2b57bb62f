// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/sliding/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapnet::scene {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Obstacle between(const Material& a, const Material& b)
{
    Obstacle obstacle;
    obstacle.friction = std::sqrt(a.friction * b.friction);
    obstacle.restitution = std::max(a.restitution, b.restitution);
    return obstacle;
}

Obstacle in_the_way(const PlaneDescription& plane, const BodyForm& movable)
{
    Obstacle obstacle = between(plane.material, movable.material);
    obstacle.is_plane = true;
    obstacle.low = glm::dvec3{-infinity};
    obstacle.high = glm::dvec3{infinity};
    int axis = 0;
    for (const int i : {1, 2}) {
        if (std::abs(plane.normal[i]) > std::abs(plane.normal[axis])) axis = i;
    }
    if (plane.normal[axis] > 0.0) {
        obstacle.high[axis] = plane.offset_m + movable.half[axis];
    } else {
        obstacle.low[axis] = -plane.offset_m - movable.half[axis];
    }
    return obstacle;
}

} // namespace

Obstacles::Obstacles(const Frozen& frozen, const Bodies& bodies, const BodyForm& movable)
    : usual_margin_{std::min(std::min(movable.half.x, movable.half.y), movable.half.z)}
{
    for (const PlaneDescription& plane : frozen.planes) {
        all_.push_back(in_the_way(plane, movable));
    }
    for (const Slot slot : bodies.slot_of) {
        if (bodies.form[slot].mass > 0.0) continue;
        Obstacle obstacle = between(bodies.form[slot].material, movable.material);
        const glm::dvec3 reach = bodies.form[slot].half + movable.half;
        obstacle.low = bodies.position.at(slot) - reach;
        obstacle.high = bodies.position.at(slot) + reach;
        all_.push_back(obstacle);
    }
    near_ = Bounded<std::uint32_t>{all_.size()};
    for (const int axis : {0, 1, 2}) {
        locked_[static_cast<std::size_t>(axis)] = movable.inverse_mass[axis] == 0.0;
    }
}

void Obstacles::look(const glm::dvec3& centre, double reach)
{
    seen_from_ = centre;
    margin_ = std::max(usual_margin_, 2.0 * reach);
    near_.clear();
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
        const Obstacle& one = all_[i];
        const bool is_near = one.gap(0, centre.x) <= margin_ && one.gap(1, centre.y) <= margin_ &&
                             one.gap(2, centre.z) <= margin_;
        if (is_near) near_.add(i);
    }
}

glm::dvec3 Obstacles::out_of(std::span<const std::uint32_t> those, glm::dvec3 centre) const
{
    for (const std::uint32_t i : those) {
        const Obstacle& one = all_[i];
        int nearest = -1;
        double least = -infinity; // the gaps are negative where the box is inside
        bool is_inside = true;
        for (const int axis : {0, 1, 2}) {
            const double gap = one.gap(axis, centre[axis]);
            is_inside = is_inside && gap < 0.0;
            if (gap > least && !locked_[static_cast<std::size_t>(axis)]) {
                least = gap;
                nearest = axis;
            }
        }
        if (!is_inside || nearest < 0) continue;
        centre[nearest] = one.face(nearest, one.side(nearest, centre[nearest]));
    }
    return centre;
}

} // namespace hapnet::scene
