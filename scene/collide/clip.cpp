// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/clip.hpp"

#include "scene/collide/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

constexpr double flush = 1.0 / 256.0; // share of a half edge
constexpr std::uint32_t polygon_max = 8;

/// A corner of the polygon where the faces overlap, in the plane of the reference face.
struct Vertex {
    double u = 0.0;
    double v = 0.0;
    double separation = 0.0; // set when the polygon is complete
    FeatureBits reference = 0;
    FeatureBits incident = 0;
};

struct Polygon {
    std::array<Vertex, polygon_max> at;
    std::uint32_t count = 0;

    void add(const Vertex& vertex) { at[count++] = vertex; }

    /// Adds a vertex with new features. In a sliver along an edge a cut may find the same features
    /// twice; only the first vertex is kept.
    void add_new(const Vertex& vertex)
    {
        for (std::uint32_t k = 0; k < count; ++k) {
            if (at[k].reference == vertex.reference && at[k].incident == vertex.incident) return;
        }
        add(vertex);
    }
};

/// The reference face's rectangle, and the incident face as a parallelogram in its coordinates.
struct Faces {
    int axis_u = 1; // axes of the reference box: the two next to the face's own, cyclically
    int axis_v = 2;
    double half_u = 0.0;
    double half_v = 0.0;
    FeatureBits reference = 0;

    int turned_axis = 0; // axis of the incident face's normal
    FeatureBits incident = 0;
    glm::dvec3 centre{0.0};           // of the incident face: u, v, height above the reference face
    glm::dvec3 first{0.0};            // one half edge of the incident face: u, v, height
    glm::dvec3 second{0.0};           // the other half edge of the incident face
    double slope_u = 0.0;             // slope of the incident plane along u
    double slope_v = 0.0;             // slope of the incident plane along v
    double beside = 0.0;              // how far the boxes are apart along u or v; < 0: they are not
    double tolerance = 0.0;           // an edge this near to another lies on it
    glm::dvec3 normal{0.0, 1.0, 0.0}; // world's frame, out of the reference face

    [[nodiscard]] double separation(double u, double v) const
    {
        return centre.z + (slope_u * (u - centre.x) + slope_v * (v - centre.y));
    }
};

/// Two opposite sides of the reference face's rectangle: where u or v is plus or minus a limit.
struct Strip {
    bool is_v = false;
    int axis = 0; // axis of the reference box along which u or v is measured
    double limit = 0.0;
    double tolerance = 0.0;

    [[nodiscard]] double place(const Vertex& vertex) const { return is_v ? vertex.v : vertex.u; }

    /// True if the line from `here` to `there` crosses a side and does not run along it.
    [[nodiscard]] bool is_crossed(double here, double there) const
    {
        return here - limit < -tolerance && there - limit > tolerance;
    }
};

/// Returns where the line from a vertex within a side to one outside crosses it.
Vertex crossing(const Vertex& within, const Vertex& without, const Strip& strip, double sign)
{
    const double inner = strip.limit - sign * strip.place(within);
    const double outer = sign * strip.place(without) - strip.limit;
    const double part = inner / (inner + outer);
    Vertex result{.u = within.u + part * (without.u - within.u),
                  .v = within.v + part * (without.v - within.v),
                  .reference =
                      (within.reference & without.reference) | face_bit(strip.axis, sign > 0.0),
                  .incident = within.incident & without.incident};
    (strip.is_v ? result.v : result.u) = sign * strip.limit;
    return result;
}

/// Returns the part of a polygon within a strip. Both sides are cut at once, so a mirrored polygon
/// gives the same bits.
Polygon cut(const Polygon& polygon, const Strip& strip)
{
    Polygon result;
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
        const Vertex& here = polygon.at[k];
        const Vertex& next = polygon.at[k + 1 < polygon.count ? k + 1 : 0];
        const double place = strip.place(here);
        const double place_next = strip.place(next);
        if (std::abs(place) - strip.limit <= strip.tolerance) result.add_new(here);
        for (const double sign : {1.0, -1.0}) // inwards
            if (strip.is_crossed(sign * place_next, sign * place))
                result.add_new(crossing(next, here, strip, sign));
        for (const double sign : {1.0, -1.0}) // outwards
            if (strip.is_crossed(sign * place, sign * place_next))
                result.add_new(crossing(here, next, strip, sign));
    }
    return result;
}

/// Returns four of more vertices: the outermost towards the four corners of the reference face,
/// deep ones first. The directions are turned a little in the sense in which the incident face is
/// twisted. So of the eight corners of two equal, twisted squares every second one is taken, and
/// not two neighbours. A mirrored scene is treated mirrored.
Polygon outermost(const Polygon& polygon, const Faces& faces)
{
    constexpr double lean = 15.0 / 16.0;
    constexpr double depth_weight = 16.0;
    const bool is_left = faces.first.x * faces.first.y < 0.0;
    Polygon result;
    std::array<bool, polygon_max> is_taken{};
    for (const unsigned corner : {0U, 1U, 2U, 3U}) {
        const double sign_u = (corner & 1U) != 0 ? -1.0 : 1.0;
        const double sign_v = (corner & 2U) != 0 ? -1.0 : 1.0;
        const bool leans_to_u = (sign_u == sign_v) != is_left;
        const double weight_u = leans_to_u ? sign_u : sign_u * lean;
        const double weight_v = leans_to_u ? sign_v * lean : sign_v;
        std::uint32_t best = 0;
        double best_score = -HUGE_VAL;
        for (std::uint32_t k = 0; k < polygon.count; ++k) {
            const Vertex& vertex = polygon.at[k];
            const double score =
                weight_u * vertex.u + weight_v * vertex.v - depth_weight * vertex.separation;
            if (score > best_score) {
                best_score = score;
                best = k;
            }
        }
        if (!is_taken[best]) result.add(polygon.at[best]);
        is_taken[best] = true;
    }
    return result;
}

Polygon cut_to_reference(const Polygon& polygon, const Faces& faces)
{
    const Strip u{.axis = faces.axis_u, .limit = faces.half_u, .tolerance = faces.tolerance};
    const Strip v{
        .is_v = true, .axis = faces.axis_v, .limit = faces.half_v, .tolerance = faces.tolerance};
    return cut(cut(polygon, u), v);
}

/// Describes the position of one box on a face of the other.
Faces facing(const OrientedBox& reference, const OrientedBox& incident, int axis)
{
    Faces faces;
    faces.axis_u = (axis + 1) % 3;
    faces.axis_v = (axis + 2) % 3;
    faces.half_u = reference.half[faces.axis_u];
    faces.half_v = reference.half[faces.axis_v];

    const glm::dvec3 offset = incident.centre - reference.centre;
    const glm::dvec3& own = reference.axes[axis];
    const glm::dvec3& u = reference.axes[faces.axis_u];
    const glm::dvec3& v = reference.axes[faces.axis_v];
    const double along = glm::dot(own, offset);
    const bool is_positive = along >= 0.0;
    faces.reference = face_bit(axis, is_positive);
    faces.normal = is_positive ? own : -own;

    const glm::dvec3 heights{glm::dot(faces.normal, incident.axes[0]),
                             glm::dot(faces.normal, incident.axes[1]),
                             glm::dot(faces.normal, incident.axes[2])};
    int rotated = 0;
    if (std::abs(heights.y) > std::abs(heights.x)) rotated = 1;
    if (std::abs(heights.z) > std::abs(heights[rotated])) rotated = 2;
    faces.turned_axis = rotated;
    const auto seen = [&](int k) {
        return glm::dvec3{glm::dot(u, incident.axes[k]), glm::dot(v, incident.axes[k]), heights[k]};
    };
    const int next = (rotated + 1) % 3;
    const int last = (rotated + 2) % 3;
    const bool looks_down = heights[rotated] < 0.0;
    faces.incident = face_bit(rotated, looks_down);
    const glm::dvec3 outward = looks_down ? seen(rotated) : -seen(rotated);
    faces.first = incident.half[next] * seen(next);
    faces.second = incident.half[last] * seen(last);
    const glm::dvec3 centre{glm::dot(u, offset), glm::dot(v, offset),
                            std::abs(along) - reference.half[axis]};
    const glm::dvec3 depth = incident.half[rotated] * outward;
    faces.centre = centre + depth;
    faces.beside =
        std::max(std::abs(centre.x) - (faces.half_u + (std::abs(depth.x) + std::abs(faces.first.x) +
                                                       std::abs(faces.second.x))),
                 std::abs(centre.y) - (faces.half_v + (std::abs(depth.y) + std::abs(faces.first.y) +
                                                       std::abs(faces.second.y))));
    faces.slope_u = -outward.x / outward.z;
    faces.slope_v = -outward.y / outward.z;
    faces.tolerance =
        flush * std::min({faces.half_u, faces.half_v, incident.half[next], incident.half[last]});
    return faces;
}

Polygon incident_corners(const Faces& faces)
{
    const int next = (faces.turned_axis + 1) % 3;
    const int last = (faces.turned_axis + 2) % 3;
    const auto corner = [&](bool first_positive, bool second_positive) {
        const double first = first_positive ? 1.0 : -1.0;
        const double second = second_positive ? 1.0 : -1.0;
        return Vertex{.u = faces.centre.x + (first * faces.first.x + second * faces.second.x),
                      .v = faces.centre.y + (first * faces.first.y + second * faces.second.y),
                      .reference = faces.reference,
                      .incident = faces.incident | face_bit(next, first_positive) |
                                  face_bit(last, second_positive)};
    };
    Polygon polygon;
    polygon.add(corner(false, false));
    polygon.add(corner(true, false));
    polygon.add(corner(true, true));
    polygon.add(corner(false, true));
    return polygon;
}

/// Keeps the vertices that are at most `margin` away. Those on the border of the reference face are
/// moved onto the face.
void leave_near(Polygon& polygon, const Faces& faces, double margin)
{
    std::uint32_t count = 0;
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
        Vertex vertex = polygon.at[k];
        vertex.u = std::clamp(vertex.u, -faces.half_u, faces.half_u);
        vertex.v = std::clamp(vertex.v, -faces.half_v, faces.half_v);
        vertex.separation = faces.separation(vertex.u, vertex.v);
        if (vertex.separation <= margin) polygon.at[count++] = vertex;
    }
    polygon.count = count;
}

} // namespace

Manifold face_manifold(const OrientedBox& reference, const OrientedBox& incident, int axis,
                       double margin)
{
    const Faces faces = facing(reference, incident, axis);
    Manifold manifold;
    manifold.normal = faces.normal;
    if (faces.beside > margin) return manifold;
    Polygon polygon = incident_corners(faces);
    const double reach_u = faces.half_u + faces.tolerance;
    const double reach_v = faces.half_v + faces.tolerance;
    bool is_within = true;
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
        const Vertex& vertex = polygon.at[k];
        is_within = is_within && std::abs(vertex.u) <= reach_u && std::abs(vertex.v) <= reach_v;
    }
    if (!is_within) polygon = cut_to_reference(polygon, faces);
    leave_near(polygon, faces, margin);
    if (polygon.count > manifold_points_max) polygon = outermost(polygon, faces);

    manifold.count = polygon.count;
    const glm::dvec3 face = reference.centre + reference.half[axis] * faces.normal;
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
        const Vertex& vertex = polygon.at[k];
        manifold.points[k] = {.position = face + (vertex.u * reference.axes[faces.axis_u] +
                                                  vertex.v * reference.axes[faces.axis_v] +
                                                  (0.5 * vertex.separation) * faces.normal),
                              .separation = vertex.separation,
                              .feature = feature_pair(vertex.reference, vertex.incident)};
    }
    return manifold;
}

namespace {

constexpr double passing_of_half = 1.0 / 256.0;

/// The edge along an axis that is farthest in a direction.
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
