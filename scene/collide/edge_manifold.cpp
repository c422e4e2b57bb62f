// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/edge_manifold.hpp"

#include "scene/collide/features.hpp"
#include "scene/collide/measures.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

constexpr double passing_of_half = 1.0 / 256.0;

/// The edge along an axis that lies farthest in a direction.
struct Edge {
    glm::dvec3 centre{0.0};
    FeatureBits feature = 0;
};

Edge outermost_edge(const OrientedBox& box, int axis, const glm::dvec3& direction)
{
    Edge edge{.centre = box.centre};
    for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) {
        const bool is_positive = glm::dot(direction, box.axes[k]) >= 0.0;
        edge.centre += (is_positive ? box.half[k] : -box.half[k]) * box.axes[k];
        edge.feature |= face_bit(k, is_positive);
    }
    return edge;
}

} // namespace

Manifold edge_manifold(const OrientedBox& a, const OrientedBox& b, EdgePair edges, double margin)
{
    const glm::dvec3& along_a = a.axes[edges.of_a];
    const glm::dvec3& along_b = b.axes[edges.of_b];
    glm::dvec3 normal = glm::cross(along_a, along_b);
    const double square = glm::dot(normal, normal);
    normal /= std::sqrt(square);
    if (glm::dot(normal, b.centre - a.centre) < 0.0) normal = -normal;

    const Edge edge_a = outermost_edge(a, edges.of_a, normal);
    const Edge edge_b = outermost_edge(b, edges.of_b, -normal);
    // The nearest points of two lines: their distance is at a right angle to both.
    const glm::dvec3 gap = edge_b.centre - edge_a.centre;
    const double cosine = glm::dot(along_a, along_b);
    const double gap_a = glm::dot(gap, along_a);
    const double gap_b = glm::dot(gap, along_b);
    const double s = (gap_a - cosine * gap_b) / square;
    const double t = (cosine * gap_a - gap_b) / square;
    const glm::dvec3 point_a = edge_a.centre + s * along_a;
    const glm::dvec3 point_b = edge_b.centre + t * along_b;

    Manifold manifold;
    manifold.normal = normal;
    const double separation = glm::dot(normal, gap);
    const double passing = passing_of_half * smallest_half(a, b);
    if (separation > margin || std::abs(s) > a.half[edges.of_a] + passing ||
        std::abs(t) > b.half[edges.of_b] + passing)
        return manifold;
    manifold.points[0] = {.position = 0.5 * (point_a + point_b),
                          .separation = separation,
                          .feature = feature_pair(edge_a.feature, edge_b.feature)};
    manifold.count = 1;
    return manifold;
}

} // namespace hapnet::scene
