// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/distance.hpp"

#include "scene/collide/round.hpp"
#include "scene/collide/sphere_box.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hapnet::scene {

namespace {

constexpr unsigned box_corners = 8;

glm::dvec3 corner_of(const OrientedBox& box, unsigned corner)
{
    const auto part = [&](unsigned bit, int axis) {
        return (corner >> bit & 1U) != 0 ? box.half[axis] : -box.half[axis];
    };
    return box.centre +
           (part(0, 0) * box.axes[0] + part(1, 1) * box.axes[1] + part(2, 2) * box.axes[2]);
}

glm::dvec3 nearest_on(const OrientedBox& box, const glm::dvec3& point)
{
    return box.centre + box.axes * glm::clamp(to_local(box, point), -box.half, box.half);
}

struct Segment {
    glm::dvec3 from{0.0};
    glm::dvec3 along{0.0};
};

/// Returns the edges of a box: four along each axis.
std::array<Segment, 12> edges_of(const OrientedBox& box)
{
    std::array<Segment, 12> edges;
    std::size_t next = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (unsigned corner = 0; corner < box_corners; ++corner) {
            if ((corner >> axis & 1U) != 0) continue;
            const auto i = static_cast<int>(axis);
            edges[next++] = {corner_of(box, corner), 2.0 * box.half[i] * box.axes[i]};
        }
    }
    return edges;
}

/// Returns the nearest points of two segments (after C. Ericson, Real-Time Collision Detection,
/// 5.1.9).
std::array<glm::dvec3, 2> nearest(const Segment& p, const Segment& q)
{
    const glm::dvec3 offset = p.from - q.from;
    const double pp = glm::dot(p.along, p.along);
    const double qq = glm::dot(q.along, q.along);
    const double pq = glm::dot(p.along, q.along);
    const double po = glm::dot(p.along, offset);
    const double qo = glm::dot(q.along, offset);
    const double across = pp * qq - pq * pq;
    constexpr double alike = 1e-16; // parallel: any point of p will do, as corners are tested, too
    double s = across > alike * pp * qq ? std::clamp((pq * qo - po * qq) / across, 0.0, 1.0) : 0.0;
    const double t = std::clamp((pq * s + qo) / qq, 0.0, 1.0);
    s = std::clamp((pq * t - po) / pp, 0.0, 1.0);
    return {p.from + s * p.along, q.from + t * q.along};
}

/// Returns the separation along the axis along which two boxes are farthest apart or overlap least.
/// Sets only `distance` and `direction`.
Separation along_best_axis(const OrientedBox& first, const OrientedBox& second)
{
    Separation best{.distance = -std::numeric_limits<double>::infinity()};
    const glm::dvec3 offset = first.centre - second.centre;
    const auto consider = [&](const glm::dvec3& axis) {
        const double square = glm::dot(axis, axis);
        constexpr double parallel_edges = 1e-16;
        if (square < parallel_edges) return;
        const glm::dvec3 unit = axis / std::sqrt(square);
        const double place = glm::dot(unit, offset);
        const double apart =
            std::abs(place) - half_projection(first, unit) - half_projection(second, unit);
        if (apart <= best.distance) return;
        best.distance = apart;
        best.direction = place < 0.0 ? -unit : unit;
    };
    for (const int i : {0, 1, 2}) consider(first.axes[i]);
    for (const int i : {0, 1, 2}) consider(second.axes[i]);
    for (const int i : {0, 1, 2}) {
        for (const int j : {0, 1, 2}) consider(glm::cross(first.axes[i], second.axes[j]));
    }
    return best;
}

/// Returns the middle of the corner, edge or face that is farthest along a direction.
glm::dvec3 farthest(const OrientedBox& box, const glm::dvec3& direction)
{
    glm::dvec3 point = box.centre;
    for (const int i : {0, 1, 2}) {
        constexpr double flat = 1e-9;
        const double along = glm::dot(direction, box.axes[i]);
        if (std::abs(along) > flat)
            point += (along < 0.0 ? -box.half[i] : box.half[i]) * box.axes[i];
    }
    return point;
}

} // namespace

Separation separation(const glm::dvec3& point, const OrientedBox& box)
{
    if (box.is_round()) return round_separation(point, box);
    const glm::dvec3 place = to_local(box, point);
    const glm::dvec3 closest = glm::clamp(place, -box.half, box.half);
    const glm::dvec3 outward = place - closest;
    const double gap = length(outward);
    Separation found{.distance = gap, .on_first = point};
    if (gap > 0.0) {
        found.direction = box.axes * (outward / gap);
        found.on_second = box.centre + box.axes * closest;
        return found;
    }
    const PerAxis from_centre{place.x, place.y, place.z};
    const BoxFace face = nearest_face(from_centre, {box.half.x, box.half.y, box.half.z});
    const int axis = face.axis;
    found.direction = static_cast<double>(face.sign) * box.axes[axis];
    found.distance = std::abs(place[axis]) - box.half[axis];
    found.on_second = point - found.distance * found.direction;
    return found;
}

Separation separation(const OrientedBox& first, const OrientedBox& second)
{
    if (first.is_round() || second.is_round()) return round_separation(first, second);
    Separation found = along_best_axis(first, second);
    if (found.distance <= 0.0) {
        found.on_first = farthest(first, -found.direction);
        found.on_second = found.on_first - found.distance * found.direction;
        return found;
    }
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 way = a - b;
        const double square = glm::dot(way, way);
        if (square >= least) return;
        least = square;
        found.on_first = a;
        found.on_second = b;
    };
    for (unsigned corner = 0; corner < box_corners; ++corner) {
        const glm::dvec3 of_first = corner_of(first, corner);
        consider(of_first, nearest_on(second, of_first));
        const glm::dvec3 of_second = corner_of(second, corner);
        consider(nearest_on(first, of_second), of_second);
    }
    const auto edges = edges_of(second);
    for (const Segment& edge : edges_of(first)) {
        for (const Segment& other : edges) {
            const auto [a, b] = nearest(edge, other);
            consider(a, b);
        }
    }
    if (least <= 0.0) return found; // nearer than rounding: the separating axis gives the result
    found.distance = std::sqrt(least);
    found.direction = (found.on_first - found.on_second) / found.distance;
    return found;
}

std::optional<RayEntry> enter(const OrientedBox& box, const glm::dvec3& origin,
                              const glm::dvec3& direction, double length)
{
    if (box.is_round()) return enter_round(box, origin, direction, length);
    const glm::dvec3 from = to_local(box, origin);
    const glm::dvec3 along = direction * box.axes;
    double first = -std::numeric_limits<double>::infinity();
    double last = length;
    int entered = 0;
    for (const int i : {0, 1, 2}) {
        if (along[i] == 0.0) {
            if (std::abs(from[i]) > box.half[i]) return std::nullopt;
            continue;
        }
        const double near = (-std::copysign(box.half[i], along[i]) - from[i]) / along[i];
        const double far = (std::copysign(box.half[i], along[i]) - from[i]) / along[i];
        if (near > first) {
            first = near;
            entered = i;
        }
        last = std::min(last, far);
    }
    if (first > last || last < 0.0) return std::nullopt;
    if (first < 0.0) return RayEntry{0.0, -direction};
    return RayEntry{first, along[entered] > 0.0 ? -box.axes[entered] : box.axes[entered]};
}

} // namespace hapnet::scene
