// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/contact/sphere_box.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

double length(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

glm::dvec3 closest_point(const glm::dvec3& half, const glm::dvec3& place)
{
    return {std::clamp(place.x, -half.x, half.x), std::clamp(place.y, -half.y, half.y),
            std::clamp(place.z, -half.z, half.z)};
}

double reach(const glm::dvec3& half)
{
    return sphere_reach_of_half * std::max({half.x, half.y, half.z});
}

Face face_towards(int axis, double value)
{
    return {.axis = static_cast<std::int8_t>(axis),
            .sign = static_cast<std::int8_t>(value < 0.0 ? -1 : 1)};
}

double along(const Face& face, const glm::dvec3& place) { return face.sign * place[face.axis]; }

/// Whether a place is in the box or behind it, seen from in front of the face.
bool is_behind(const Face& face, const glm::dvec3& half, const glm::dvec3& place)
{
    const int u = (face.axis + 1) % 3;
    const int v = (face.axis + 2) % 3;
    const double depth = half[face.axis] - along(face, place);
    return depth >= 0.0 && depth <= 2.0 * half[face.axis] + reach(half) &&
           std::abs(place[u]) <= half[u] && std::abs(place[v]) <= half[v];
}

/// The face at which a straight way from outside goes into the box, however shortly.
std::optional<Face> entry(const glm::dvec3& half, const glm::dvec3& from, const glm::dvec3& to)
{
    std::optional<Face> face;
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
            face = face_towards(axis, near);
        }
        out = std::min(out, (-near - from[axis]) / way);
    }
    return in < out ? face : std::nullopt;
}

Face nearest_face(const glm::dvec3& half, const glm::dvec3& inside)
{
    int nearest = 0;
    for (const int axis : {1, 2}) {
        if (half[axis] - std::abs(inside[axis]) < half[nearest] - std::abs(inside[nearest]))
            nearest = axis;
    }
    return face_towards(nearest, inside[nearest]);
}

Face outward_face(const glm::dvec3& outward)
{
    int farthest = 0;
    for (const int axis : {1, 2}) {
        if (std::abs(outward[axis]) > std::abs(outward[farthest])) farthest = axis;
    }
    return face_towards(farthest, outward[farthest]);
}

SphereOverlap behind(const Face& face, const OrientedBox& box, const glm::dvec3& place,
                     double radius)
{
    const double side = face.sign;
    glm::dvec3 surface = place;
    surface[face.axis] = side * box.half[face.axis];
    return {.depth = radius + (box.half[face.axis] - along(face, place)),
            .normal = side * box.axes[face.axis],
            .point = box.centre + box.axes * surface};
}

} // namespace

std::optional<SphereOverlap> SphereBoxMemory::find(const OrientedBox& box, const glm::dvec3& centre,
                                                   double radius)
{
    const glm::dvec3 place = seen_from(box, centre);
    if (entered_ && is_behind(*entered_, box.half, place))
        return behind(*entered_, box, place, radius);
    const glm::dvec3 closest = closest_point(box.half, place);
    const glm::dvec3 outward = place - closest;
    const double gap = length(outward);
    if (gap >= radius) {
        forget();
        return std::nullopt;
    }
    if (gap > 0.0) {
        entered_ = outward_face(outward);
        return SphereOverlap{.depth = radius - gap,
                             .normal = box.axes * (outward / gap),
                             .point = box.centre + box.axes * closest};
    }
    entered_ = nearest_face(box.half, place);
    return behind(*entered_, box, place, radius);
}

std::optional<SphereOverlap> SphereBoxMemory::find(const OrientedBox& box, const glm::dvec3& centre,
                                                   double radius, const glm::dvec3& before)
{
    const glm::dvec3 place = seen_from(box, centre);
    const bool was_behind = entered_ && is_behind(*entered_, box.half, before);
    const bool was_put = length(place - before) > reach(box.half);
    if (was_put || (was_behind && !is_behind(*entered_, box.half, place)))
        forget();
    else if (!was_behind)
        entered_ = entry(box.half, before, place);
    return find(box, centre, radius);
}

glm::dvec3 seen_from(const OrientedBox& box, const glm::dvec3& point)
{
    const glm::dvec3 offset = point - box.centre;
    return {glm::dot(box.axes[0], offset), glm::dot(box.axes[1], offset),
            glm::dot(box.axes[2], offset)};
}

double distance(const OrientedBox& box, const glm::dvec3& point)
{
    const glm::dvec3 place = seen_from(box, point);
    return length(place - closest_point(box.half, place));
}

} // namespace hapnet::scene
