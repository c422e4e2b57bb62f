// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/sphere_box.hpp"

#include "scene/maths/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

glm::dvec3 closest_point(const glm::dvec3& half, const glm::dvec3& place)
{
    return {std::clamp(place.x, -half.x, half.x), std::clamp(place.y, -half.y, half.y),
            std::clamp(place.z, -half.z, half.z)};
}

double reach(const glm::dvec3& half)
{
    return sphere_reach_of_half * std::max({half.x, half.y, half.z});
}

double along(const BoxFace& face, const glm::dvec3& place) { return face.sign * place[face.axis]; }

/// True if a place is in the box or behind it, as seen from in front of the face.
bool is_behind(const BoxFace& face, const glm::dvec3& half, const glm::dvec3& place)
{
    const int u = (face.axis + 1) % 3;
    const int v = (face.axis + 2) % 3;
    const double depth = half[face.axis] - along(face, place);
    return depth >= 0.0 && depth <= 2.0 * half[face.axis] + reach(half) &&
           std::abs(place[u]) <= half[u] && std::abs(place[v]) <= half[v];
}

/// Returns the face at which a straight line from outside enters the box, however short its way
/// inside is.
std::optional<BoxFace> entry(const glm::dvec3& half, const glm::dvec3& from, const glm::dvec3& to)
{
    std::optional<BoxFace> face;
    double in = 0.0;
    double out = 1.0;
    for (const int axis : {0, 1, 2}) {
        const double way = to[axis] - from[axis];
        if (way == 0.0) {
            if (std::abs(from[axis]) >= half[axis]) return std::nullopt;
            continue;
        }
        const double near = way > 0.0 ? -half[axis] : half[axis];
        const double first = (near - from[axis]) / way;
        if (first > in || (first == in && !face && std::abs(from[axis]) >= half[axis])) {
            in = first;
            face = face_at(static_cast<std::size_t>(axis), near);
        }
        out = std::min(out, (-near - from[axis]) / way);
    }
    return in < out ? face : std::nullopt;
}

BoxFace outward_face(const glm::dvec3& outward)
{
    int farthest = 0;
    for (const int axis : {1, 2}) {
        if (std::abs(outward[axis]) > std::abs(outward[farthest])) farthest = axis;
    }
    return face_at(static_cast<std::size_t>(farthest), outward[farthest]);
}

LocalOverlap behind(const BoxFace& face, const glm::dvec3& half, const glm::dvec3& place,
                    double radius)
{
    LocalOverlap overlap{.depth = radius + (half[face.axis] - along(face, place)), .point = place};
    overlap.normal[face.axis] = face.sign;
    overlap.point[face.axis] = face.sign * half[face.axis];
    return overlap;
}

/// Returns the side of a box on which a place is, along one axis: -1, 1, or 0 between its faces.
int side_of(double half, double place)
{
    return static_cast<int>(place > half) - static_cast<int>(place < -half);
}

SphereOverlap in_world(const OrientedBox& box, const LocalOverlap& overlap)
{
    return {.depth = overlap.depth,
            .normal = box.axes * overlap.normal,
            .point = box.centre + box.axes * overlap.point};
}

} // namespace

std::optional<LocalOverlap> SphereBoxMemory::find_here(const glm::dvec3& half,
                                                       const glm::dvec3& place, double radius)
{
    if (entered_ && is_behind(*entered_, half, place))
        return behind(*entered_, half, place, radius);
    const glm::dvec3 closest = closest_point(half, place);
    const glm::dvec3 outward = place - closest;
    const double gap = length(outward);
    if (gap >= radius) {
        forget();
        return std::nullopt;
    }
    if (gap > 0.0) {
        entered_ = outward_face(outward);
        return LocalOverlap{.depth = radius - gap, .normal = outward / gap, .point = closest};
    }
    entered_ = nearest_face(per_axis(place), per_axis(half));
    return behind(*entered_, half, place, radius);
}

LocalOverlap SphereBoxMemory::enter(BoxFace face, const glm::dvec3& half, const glm::dvec3& place,
                                    double radius)
{
    entered_ = face;
    return behind(face, half, place, radius);
}

std::optional<LocalOverlap> SphereBoxMemory::find(const glm::dvec3& half, const glm::dvec3& place,
                                                  double radius, const glm::dvec3* before)
{
    if (before == nullptr) return find_here(half, place, radius);
    const PerAxis here = per_axis(place);
    const PerAxis there = per_axis(*before);
    const PerAxis edge = per_axis(half);
    const std::array<int, 3> sides{side_of(half.x, place.x), side_of(half.y, place.y),
                                   side_of(half.z, place.z)};
    const std::size_t axis = sides[0] != 0 ? 0 : sides[1] != 0 ? 1 : 2;
    const int side = sides[axis];
    const bool is_face = std::abs(sides[0]) + std::abs(sides[1]) + std::abs(sides[2]) == 1;
    const bool stays = side != 0 && side_of(edge[axis], there[axis]) == side;
    const bool is_through = entered_ && entered_->axis == axis && entered_->sign == -side;
    if (stays && !is_through) {
        // The centre was and is in front of a face, so it entered through none.
        const double gap = side * here[axis] - edge[axis];
        if (gap >= radius) {
            forget();
            return std::nullopt;
        }
        if (is_face) {
            entered_ = face_at(axis, side);
            PerAxis normal{};
            PerAxis point = here;
            normal[axis] = side;
            point[axis] = side * edge[axis];
            int within = 0;
            for (const std::size_t i : {0U, 1U, 2U})
                within += static_cast<int>(std::abs(here[i]) <= amid_face_share * edge[i]);
            return LocalOverlap{radius - gap, vector(normal), vector(point), within == 2};
        }
    }
    const bool was_behind = entered_ && is_behind(*entered_, half, *before);
    const bool was_put = length(place - *before) > reach(half);
    if (was_put || (was_behind && !is_behind(*entered_, half, place)))
        forget();
    else if (!was_behind)
        entered_ = entry(half, *before, place);
    return find_here(half, place, radius);
}

std::optional<SphereOverlap> SphereBoxMemory::find(const OrientedBox& box, const glm::dvec3& centre,
                                                   double radius)
{
    const auto overlap = find(box.half, to_local(box, centre), radius, nullptr);
    if (!overlap) return std::nullopt;
    return in_world(box, *overlap);
}

std::optional<SphereOverlap> SphereBoxMemory::find(const OrientedBox& box, const glm::dvec3& centre,
                                                   double radius, const glm::dvec3& before)
{
    const auto overlap = find(box.half, to_local(box, centre), radius, &before);
    if (!overlap) return std::nullopt;
    return in_world(box, *overlap);
}

double distance(const OrientedBox& box, const glm::dvec3& point)
{
    const glm::dvec3 place = to_local(box, point);
    const double apart = length(place - closest_point(box.half - box.rounding, place));
    return std::max(apart - box.rounding, 0.0);
}

} // namespace hapnet::scene
