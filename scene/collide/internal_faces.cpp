// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/internal_faces.hpp"

#include "scene/collide/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hapnet::scene {

namespace {

// Boxes no farther apart than this share of the smallest half edge lie flush.
constexpr double flush_share = 1e-5;
// The rounding of a box's place, as a share of a half edge.
constexpr double place_rounding = 1e-12;
// The lean of normals that do not lead through a face. A sphere beside an edge may lean over it by
// any angle. A box that has tilted on a floor pushes along its own face, which leans as much as the
// box.
constexpr double lean_of_round = 1e-9, lean_of_box = 1.0 / 64.0;

double smallest(const glm::dvec3& half) { return std::min({half.x, half.y, half.z}); }

bool is_in(const OrientedBox& box, const glm::dvec3& point, double within)
{
    const glm::dvec3 beyond = glm::abs(to_local(box, point)) - box.half;
    return std::max({beyond.x, beyond.y, beyond.z}) <= within;
}

/// Returns the half extents of a box along the axes of the world.
glm::dvec3 reach_of(const OrientedBox& box)
{
    return {half_projection(box, {1.0, 0.0, 0.0}), half_projection(box, {0.0, 1.0, 0.0}),
            half_projection(box, {0.0, 0.0, 1.0})};
}

bool lie_flush(const OrientedBox& a, const OrientedBox& b)
{
    BoxBoxMemory none;
    return collide(a, b, flush_share * smallest_half(a, b), none).count > 0;
}

OrientedBox seen_from(const OrientedBox& frame, const OrientedBox& box)
{
    return {to_local(frame, box.centre), glm::transpose(frame.axes) * box.axes, box.half};
}

using Couple = std::pair<PartId, PartId>;

/// Returns the pairs of boxes of one solid that lie flush, each pair once, by a sweep along x.
std::vector<Couple> flush_couples(const Bodies& bodies)
{
    struct Entry {
        PartId part = 0;
        OrientedBox box;
        glm::dvec3 reach{0.0};
    };
    std::vector<Entry> entries;
    for (PartId part = 0; part < bodies.parts_count(); ++part) {
        const Slot slot = bodies.slot_of[part];
        const bool is_fixed = slot >= bodies.moving;
        const OrientedBox box = shape_of(bodies, part);
        if (box.is_round() || (!is_fixed && !bodies.properties[slot].has_parts())) continue;
        entries.push_back({part, box, reach_of(box)});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& one, const Entry& other) {
        return one.box.centre.x - one.reach.x < other.box.centre.x - other.reach.x;
    });
    const auto are_of_one_solid = [&](PartId one, PartId other) {
        const Slot a = bodies.slot_of[one], b = bodies.slot_of[other];
        return a == b || (a >= bodies.moving && b >= bodies.moving);
    };
    std::vector<Couple> couples;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& one = entries[i];
        const double end = one.box.centre.x + one.reach.x + flush_share * smallest(one.box.half);
        for (std::size_t j = i + 1; j < entries.size(); ++j) {
            const Entry& other = entries[j];
            if (other.box.centre.x - other.reach.x > end) break;
            if (are_of_one_solid(one.part, other.part) && lie_flush(one.box, other.box))
                couples.emplace_back(one.part, other.part);
        }
    }
    return couples;
}

} // namespace

InternalFaces::InternalFaces(const Bodies& bodies)
{
    std::vector<Couple> couples = flush_couples(bodies);
    if (couples.empty()) return;
    const std::size_t count = couples.size();
    for (std::size_t i = 0; i < count; ++i)
        couples.emplace_back(couples[i].second, couples[i].first);
    std::sort(couples.begin(), couples.end());
    first_.assign(bodies.parts_count() + std::size_t{1}, 0);
    for (const auto& [part, other] : couples) {
        ++first_[part + std::size_t{1}];
        neighbours_.push_back({other, seen_from(shape_of(bodies, part), shape_of(bodies, other))});
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
}

/// True if a neighbour covers a face at its nearest point to `place`. The probe is slightly outside
/// the face and slightly inside its border, so that a neighbour that ends at the border does not
/// cover it.
bool InternalFaces::is_covered(PartId part, const glm::dvec3& half, const glm::dvec3& place,
                               const BoxFace& face) const
{
    const double hair = 2.0 * flush_share * smallest(half);
    glm::dvec3 probe = glm::clamp(place, -half + hair, half - hair);
    probe[face.axis] = face.sign * (half[face.axis] + hair);
    for (std::uint32_t i = first_[part]; i < first_[part + std::size_t{1}]; ++i)
        if (is_in(neighbours_[i].box, probe, -0.5 * hair)) return true;
    return false;
}

bool InternalFaces::leads_inside(PartId part, const glm::dvec3& half, const LocalOverlap& at,
                                 double lean) const
{
    for (const int axis : {0, 1, 2}) {
        if (std::abs(at.normal[axis]) <= lean) continue;
        const BoxFace face = face_at(static_cast<std::size_t>(axis), at.normal[axis]);
        // A box that touches with its own face or edge pushes at an angle, away from other faces.
        constexpr double near = 1.0 / 16.0, straight = 1.0 - 1e-6;
        const double below = half[axis] - face.sign * at.point[axis];
        if (below > near * smallest(half) && std::abs(at.normal[axis]) < straight) continue;
        if (is_covered(part, half, at.point, face)) return true;
    }
    return false;
}

bool InternalFaces::is_shared(PartId part, const LocalOverlap& at) const
{
    for (std::uint32_t i = first_[part]; i < first_[part + std::size_t{1}]; ++i) {
        const Neighbour& other = neighbours_[i];
        if (other.part > part) return false; // neighbours are sorted by part
        const double size = smallest(other.box.half);
        if (is_in(other.box, at.point - flush_share * size * at.normal, place_rounding * size))
            return true;
    }
    return false;
}

std::optional<BoxFace> InternalFaces::nearest_outer_face(PartId part, const glm::dvec3& half,
                                                         const glm::dvec3& place) const
{
    std::optional<BoxFace> nearest;
    double least = HUGE_VAL;
    for (const int axis : {0, 1, 2}) {
        for (const double side : {-1.0, 1.0}) {
            const double depth = half[axis] - side * place[axis];
            const BoxFace face = face_at(static_cast<std::size_t>(axis), side);
            if (depth >= least || is_covered(part, half, place, face)) continue;
            least = depth;
            nearest = face;
        }
    }
    return nearest;
}

void InternalFaces::leave_outer(const Side& a, const Side& b, Manifold& manifold) const
{
    if (manifold.count == 0) return;
    const double lean = a.box.is_round() || b.box.is_round() ? lean_of_round : lean_of_box;
    if (has(a.part)) leave_outer_of(a, true, lean, manifold);
    if (has(b.part)) leave_outer_of(b, false, lean, manifold);
}

void InternalFaces::leave_outer_of(const Side& side, bool is_first, double lean,
                                   Manifold& manifold) const
{
    const glm::dvec3 normal = (is_first ? manifold.normal : -manifold.normal) * side.box.axes;
    std::uint32_t count = 0;
    for (const ContactPoint& point : manifold.touching()) {
        const LocalOverlap at{.normal = normal, .point = to_local(side.box, point.position)};
        if (!leads_inside(side.part, side.box.half, at, lean)) manifold.points[count++] = point;
    }
    manifold.count = count;
}

} // namespace hapnet::scene
