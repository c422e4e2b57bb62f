// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/box_box.hpp"

#include "scene/collide/clip.hpp"
#include "scene/collide/manifold.hpp"
#include "scene/collide/round.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

// Separating axes after Gottschalk, Lin and Manocha 1996. The separation along each of the 15 axes
// is the distance of the boxes' centres less the half extents of both. Where all separations are
// negative the boxes overlap, and the greatest one determines which features meet. The choice has
// slack: it prefers a face to an edge, and the last tick's axis to others.

namespace hapnet::scene {

namespace {

using Triple = std::array<double, 3>;

constexpr int first_edge_axis = 6;
constexpr double slack_of_half = 1.0 / 128.0;
// The squared sine of the angle below which two edges count as parallel. The faces' axes are then
// within that angle, and a normal from so short a cross product would consist of rounding errors.
constexpr double parallel = 1e-6;

EdgePair edges_of(int axis)
{
    return {.of_a = (axis - first_edge_axis) / 3, .of_b = (axis - first_edge_axis) % 3};
}

double slack(const OrientedBox& a, const OrientedBox& b)
{
    return slack_of_half * smallest_half(a, b);
}

/// Returns a manifold without points. The points are not written.
Manifold apart()
{
    Manifold manifold;
    return manifold;
}

/// Returns the distance of `other` from the face of `owner` that faces it, across one of the
/// owner's axes.
double face_separation(const OrientedBox& owner, const OrientedBox& other, int axis)
{
    const glm::dvec3& normal = owner.axes[axis];
    return std::abs(glm::dot(normal, other.centre - owner.centre)) -
           (owner.half[axis] + half_projection(other, normal));
}

double face_separation_of(const OrientedBox& a, const OrientedBox& b, int axis)
{
    return axis < 3 ? face_separation(a, b, axis) : face_separation(b, a, axis - 3);
}

/// True if the boxes are more than `margin` apart along the common normal of two edges.
bool edges_separate(const OrientedBox& a, const OrientedBox& b, EdgePair edges, double margin)
{
    const glm::dvec3 normal = glm::cross(a.axes[edges.of_a], b.axes[edges.of_b]);
    const double square = glm::dot(normal, normal);
    if (square < parallel) return false;
    const double separation = std::abs(glm::dot(normal, b.centre - a.centre)) -
                              (half_projection(a, normal) + half_projection(b, normal));
    return separation > margin * std::sqrt(square);
}

Manifold exchanged(Manifold manifold)
{
    manifold.normal = -manifold.normal;
    for (ContactPoint& point : manifold.touching())
        point.feature = swapped_feature_pair(point.feature);
    return manifold;
}

Manifold touching_on_face(const OrientedBox& a, const OrientedBox& b, int axis, double margin)
{
    return axis < 3 ? face_manifold(a, b, axis, margin)
                    : exchanged(face_manifold(b, a, axis - 3, margin));
}

/// An axis, and the separation of the boxes along it.
struct Candidate {
    double separation = -HUGE_VAL;
    int axis = -1;

    void consider(double other_separation, int other_axis)
    {
        if (other_separation > separation) *this = {other_separation, other_axis};
    }
};

/// The separations along all axes: two boxes, each in the frame of the other.
class Separations {
public:
    Separations(const OrientedBox& a, const OrientedBox& b)
        : half_a_{a.half.x, a.half.y, a.half.z}, half_b_{b.half.x, b.half.y, b.half.z}
    {
        const glm::dvec3 offset = b.centre - a.centre;
        for (const int i : {0, 1, 2}) {
            along_a_[index(i)] = glm::dot(a.axes[i], offset);
            along_b_[index(i)] = glm::dot(b.axes[i], offset);
            for (const int j : {0, 1, 2}) {
                const double cosine = glm::dot(a.axes[i], b.axes[j]);
                cosine_[index(i)][index(j)] = cosine;
                size_[index(i)][index(j)] = std::abs(cosine);
            }
        }
    }

    [[nodiscard]] double face_of_a(std::size_t i) const
    {
        return std::abs(along_a_[i]) -
               (half_a_[i] +
                (half_b_[0] * size_[i][0] + half_b_[1] * size_[i][1] + half_b_[2] * size_[i][2]));
    }

    [[nodiscard]] double face_of_b(std::size_t j) const
    {
        return std::abs(along_b_[j]) -
               (half_b_[j] +
                (half_a_[0] * size_[0][j] + half_a_[1] * size_[1][j] + half_a_[2] * size_[2][j]));
    }

    /// Returns the squared length of the cross product of two edges.
    [[nodiscard]] double square(std::size_t i, std::size_t j) const
    {
        return 1.0 - size_[i][j] * size_[i][j];
    }

    /// Returns the separation along the cross product of two edges, times its length.
    [[nodiscard]] double edges(std::size_t i, std::size_t j) const
    {
        const std::size_t i1 = (i + 1) % 3;
        const std::size_t i2 = (i + 2) % 3;
        const std::size_t j1 = (j + 1) % 3;
        const std::size_t j2 = (j + 2) % 3;
        const double extent_a = half_a_[i1] * size_[i2][j] + half_a_[i2] * size_[i1][j];
        const double extent_b = half_b_[j1] * size_[i][j2] + half_b_[j2] * size_[i][j1];
        return std::abs(along_a_[i2] * cosine_[i1][j] - along_a_[i1] * cosine_[i2][j]) -
               (extent_a + extent_b);
    }

private:
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }

    std::array<Triple, 3> cosine_{};
    std::array<Triple, 3> size_{};
    Triple along_a_{};
    Triple along_b_{};
    Triple half_a_{};
    Triple half_b_{};
};

/// The result of the test of all axes: one that separates by more than the margin, or the best of
/// each kind.
struct Verdict {
    int separating = -1;
    Candidate face_a;
    Candidate face_b;
    Candidate edge; // axis -1: all edges are parallel, or none could be the best
};

Verdict judge(const Separations& separations, double margin)
{
    Verdict verdict;
    for (const int i : {0, 1, 2}) {
        verdict.face_a.consider(separations.face_of_a(static_cast<std::size_t>(i)), i);
        verdict.face_b.consider(separations.face_of_b(static_cast<std::size_t>(i)), i + 3);
    }
    const Candidate& face =
        verdict.face_b.separation > verdict.face_a.separation ? verdict.face_b : verdict.face_a;
    if (face.separation > margin) {
        verdict.separating = face.axis;
        return verdict;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double square = separations.square(i, j);
            if (square < parallel) continue;
            const double scaled = separations.edges(i, j);
            const int axis = first_edge_axis + static_cast<int>(3 * i + j);
            const double separation = scaled / std::sqrt(square);
            if (separation > margin) {
                verdict.separating = axis;
                return verdict;
            }
            verdict.edge.consider(separation, axis);
        }
    }
    return verdict;
}

/// Returns the area of a candidate's face, up to a factor.
double area(const OrientedBox& box, int axis)
{
    return box.half[(axis + 1) % 3] * box.half[(axis + 2) % 3];
}

/// Returns the best face of both boxes. Of two equally good faces it is the larger, since the other
/// one then lies within it; else the first box's.
Candidate better_face(const OrientedBox& a, const OrientedBox& b, const Verdict& verdict)
{
    const Candidate& face_a = verdict.face_a;
    const Candidate& face_b = verdict.face_b;
    const double lead = face_b.separation - face_a.separation;
    const double room = slack(a, b);
    if (lead > room) return face_b;
    if (lead < -room) return face_a;
    const bool is_larger = area(b, face_b.axis - 3) > (1.0 + slack_of_half) * area(a, face_a.axis);
    return is_larger ? face_b : face_a;
}

/// Returns the edges' axis to try: last tick's while it is nearly as good as the best.
int better_edges(const Separations& separations, const Candidate& best, double room, int last)
{
    if (last < first_edge_axis) return best.axis;
    const auto i = static_cast<std::size_t>(edges_of(last).of_a);
    const auto j = static_cast<std::size_t>(edges_of(last).of_b);
    const double square = separations.square(i, j);
    if (square < parallel) return best.axis;
    const double separation = separations.edges(i, j) / std::sqrt(square);
    return separation >= best.separation - room ? last : best.axis;
}

/// Tests all 15 axes and finds the points where the features of the best one meet.
Manifold search(const OrientedBox& a, const OrientedBox& b, double margin, BoxBoxMemory& memory)
{
    const Separations separations{a, b};
    const Verdict verdict = judge(separations, margin);
    const int last = std::exchange(memory.axis, static_cast<std::int8_t>(verdict.separating));
    if (verdict.separating >= 0) return apart();

    const double room = slack(a, b);
    const Candidate best = better_face(a, b, verdict);
    Candidate face = best;
    if (last >= 0 && last < first_edge_axis) {
        const double separation = face_separation_of(a, b, last);
        if (separation >= best.separation - room) face = {separation, last};
    }
    const bool were_edges = last >= first_edge_axis;
    const double lead = verdict.edge.separation - face.separation;
    const bool are_edges = lead > (were_edges ? 0.5 : 1.0) * room;
    const int edges = better_edges(separations, verdict.edge, room, last);

    // The slack may have chosen features that do not meet. Then the next best are tried, and
    // finally the best.
    const std::array<int, 6> axes{are_edges ? edges : face.axis,
                                  are_edges ? verdict.edge.axis : edges,
                                  face.axis,
                                  verdict.edge.axis,
                                  verdict.face_a.axis,
                                  verdict.face_b.axis};
    for (const int axis : axes) {
        if (axis < 0) continue;
        const Manifold manifold = axis < first_edge_axis
                                      ? touching_on_face(a, b, axis, margin)
                                      : edge_manifold(a, b, edges_of(axis), margin);
        if (manifold.count == 0) continue;
        memory.axis = static_cast<std::int8_t>(axis);
        return manifold;
    }
    memory.axis = static_cast<std::int8_t>(face.axis);
    return apart();
}

} // namespace

Manifold collide(const OrientedBox& a, const OrientedBox& b, double margin, BoxBoxMemory& memory)
{
    if (a.is_round() || b.is_round()) return round_manifold(a, b, margin);
    const auto last = int{memory.axis};
    if (last >= first_edge_axis) {
        if (edges_separate(a, b, edges_of(last), margin)) return apart();
    } else if (last >= 0) {
        const double separation = face_separation_of(a, b, last);
        if (separation > margin) return apart();
        if (separation >= -slack(a, b)) { // no other axis can be better by more than the slack
            const Manifold manifold = touching_on_face(a, b, last, margin);
            if (manifold.count > 0) return manifold;
        }
    }
    return search(a, b, margin, memory);
}

} // namespace hapnet::scene
