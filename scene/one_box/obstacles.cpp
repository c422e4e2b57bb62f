// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapnet::scene {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Obstacle plane_obstacle(const PlaneDescription& plane, const BodyProperties& movable)
{
    Obstacle obstacle{.material = combined(plane.material, movable.material)};
    obstacle.is_plane = true;
    obstacle.low.fill(-infinity);
    obstacle.high.fill(infinity);
    for (std::size_t i = 0; i < 3; ++i) { // a unit vector along one of the axes
        const auto axis = static_cast<int>(i);
        if (std::abs(plane.normal[axis]) > 0.5) obstacle.normal_axis = i;
        if (plane.normal[axis] > 0.5) obstacle.high[i] = plane.offset_m + movable.half[axis];
        if (plane.normal[axis] < -0.5) obstacle.low[i] = -plane.offset_m - movable.half[axis];
    }
    return obstacle;
}

} // namespace

Obstacles::Obstacles(const WorldConfig& config, const Bodies& bodies, const BodyProperties& movable)
    : default_margin_{std::min(std::min(movable.half.x, movable.half.y), movable.half.z)}
{
    for (const PlaneDescription& plane : config.planes) {
        all_.push_back(plane_obstacle(plane, movable));
    }
    for (const Slot slot : bodies.slot_of) {
        if (bodies.properties[slot].mass > 0.0) continue;
        Obstacle obstacle{.material = combined(bodies.properties[slot].material, movable.material)};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<int>(i);
            const double reach = bodies.properties[slot].half[axis] + movable.half[axis];
            obstacle.low[i] = bodies.position.at(slot)[axis] - reach;
            obstacle.high[i] = bodies.position.at(slot)[axis] + reach;
        }
        all_.push_back(obstacle);
    }
    nearby_ = Bounded<std::uint32_t>{all_.size()};
    for (std::size_t i = 0; i < 3; ++i) {
        locked_[i] = movable.inverse_mass[static_cast<int>(i)] == 0.0;
    }
}

void Obstacles::refresh(const PerAxis& centre, double reach)
{
    query_centre_ = centre;
    margin_ = std::max(default_margin_, 2.0 * reach);
    nearby_.clear();
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
        const Obstacle& one = all_[i];
        const bool is_near = one.gap(0, centre[0]) <= margin_ && one.gap(1, centre[1]) <= margin_ &&
                             one.gap(2, centre[2]) <= margin_;
        if (is_near) nearby_.add(i);
    }
}

bool Obstacles::push_out(std::span<const std::uint32_t> of_those, PerAxis& centre) const
{
    bool was_inside = false;
    for (const std::uint32_t id : of_those) {
        const Obstacle& one = all_[id];
        if (one.is_plane) {
            const std::size_t axis = one.normal_axis;
            if (locked_[axis] || one.gap(axis, centre[axis]) >= 0.0) continue;
            centre[axis] = one.face(axis, one.side(axis, centre[axis]));
            was_inside = true;
            continue;
        }
        PerAxis gaps{};
        for (std::size_t i = 0; i < 3; ++i) gaps[i] = one.gap(i, centre[i]);
        if (gaps[0] >= 0.0 || gaps[1] >= 0.0 || gaps[2] >= 0.0) continue;
        std::size_t nearest = 3;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!locked_[i] && (nearest == 3 || gaps[i] > gaps[nearest])) nearest = i;
        }
        if (nearest == 3) continue;
        centre[nearest] = one.face(nearest, one.side(nearest, centre[nearest]));
        was_inside = true;
    }
    return was_inside;
}

} // namespace hapnet::scene
