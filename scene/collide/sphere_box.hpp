// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"
#include "scene/maths/vector.hpp"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>

namespace hapnet::scene {

inline constexpr std::uint8_t no_axis = 3;

/// A face of a box, or none.
struct BoxFace {
    std::uint8_t axis = no_axis;
    std::int8_t sign = 1;

    friend bool operator==(const BoxFace&, const BoxFace&) = default;
};
/// Returns the face across `axis` on the side of a place, given from the box's centre.
[[nodiscard]] inline BoxFace face_at(std::size_t axis, double place)
{
    return {static_cast<std::uint8_t>(axis), static_cast<std::int8_t>(place < 0.0 ? -1 : 1)};
}
/// Returns the face nearest to a place within the box.
[[nodiscard]] inline BoxFace nearest_face(const PerAxis& place, const PerAxis& half)
{
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        if (half[i] - std::abs(place[i]) < half[nearest] - std::abs(place[nearest])) nearest = i;
    }
    return face_at(nearest, place[nearest]);
}

/// The overlap of a sphere and a box, in the world's frame.
struct SphereOverlap {
    double depth = 0.0;     // metres, > 0
    glm::dvec3 normal{0.0}; // unit, from the box to the sphere
    glm::dvec3 point{0.0};  // on the surface of the box, nearest to the centre along the normal
};

/// The overlap in the box's frame.
struct LocalOverlap {
    double depth = 0.0;
    glm::dvec3 normal{0.0};
    glm::dvec3 point{0.0};
    bool is_amid_face = false;
};

/// A place is amid a face if it is no farther from the middle than this share of the half edges.
inline constexpr double amid_face_share = 0.9;

/// The limit of a sphere's path in one tick, and of its depth behind the face where it entered, in
/// units of the box's longest half edge. A sphere beyond the limit counts as newly placed, and its
/// past is forgotten. For a cube of 4 cm the limit is 8 cm, that is 80 m/s at 1 kHz.
inline constexpr double sphere_reach_of_half = 4.0;

/// Finds how a sphere overlaps a box, and remembers the face through which the sphere's centre
/// entered. So a deep push does not jump to another face. A sphere that has passed through the box,
/// pushed slowly or within one tick, is still found in front of the face where it entered. The
/// memory ends when the centre leaves through that face or leaves the space behind it sideways. For
/// a centre outside the box the nearest point of the box decides, so the depth is continuous over
/// edges and corners.
class SphereBoxMemory {
public:
    /// Finds the overlap of a sphere without a known earlier place. nullopt: they do not overlap.
    [[nodiscard]] std::optional<SphereOverlap> find(const OrientedBox& box,
                                                    const glm::dvec3& centre, double radius);

    /// Finds the overlap of a sphere whose centre was at `before` a tick ago, in the box's frame of
    /// that time; see to_local(). The entered face is the first one that the straight line from
    /// `before` to the centre meets. nullopt: they do not overlap.
    [[nodiscard]] std::optional<SphereOverlap>
    find(const OrientedBox& box, const glm::dvec3& centre, double radius, const glm::dvec3& before);

    /// As find(), in the frame of a box with these half edges. `before` is null when it is not
    /// known. A sphere that is far away or in front of one of the faces, as most are, costs a few
    /// comparisons.
    [[nodiscard]] std::optional<LocalOverlap> find(const glm::dvec3& half, const glm::dvec3& place,
                                                   double radius, const glm::dvec3* before);

    void forget() { entered_.reset(); }
    /// Puts a sphere whose centre is in the box behind another face.
    [[nodiscard]] LocalOverlap enter(BoxFace face, const glm::dvec3& half, const glm::dvec3& place,
                                     double radius);

    /// Returns the face through which the centre entered, or would enter on its shortest path.
    [[nodiscard]] std::optional<BoxFace> entered() const { return entered_; }

    friend bool operator==(const SphereBoxMemory&, const SphereBoxMemory&) = default;

private:
    [[nodiscard]] std::optional<LocalOverlap> find_here(const glm::dvec3& half,
                                                        const glm::dvec3& place, double radius);

    std::optional<BoxFace> entered_;
};

/// Returns a point of the world in a box's own frame.
[[nodiscard]] inline glm::dvec3 to_local(const OrientedBox& box, const glm::dvec3& point)
{
    const glm::dvec3 offset = point - box.centre;
    return {glm::dot(box.axes[0], offset), glm::dot(box.axes[1], offset),
            glm::dot(box.axes[2], offset)};
}

/// Returns the distance from a point to the surface of a box or a round body; 0 inside.
[[nodiscard]] double distance(const OrientedBox& box, const glm::dvec3& point);

} // namespace hapnet::scene
