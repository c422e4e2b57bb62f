// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace hapnet::scene {

/// A box anywhere, whose axes are the columns of a rotation; or the sphere or the capsule that fits
/// into that box.
struct OrientedBox {
    glm::dvec3 centre{0.0};
    glm::dmat3 axes{1.0};
    glm::dvec3 half{0.02};
    double rounding = 0.0; // m: from the core of a sphere or a capsule to its surface

    [[nodiscard]] bool is_round() const { return rounding > 0.0; }
};

/// A point where two bodies touch, or would within the margin.
struct ContactPoint {
    glm::dvec3 position;   // world, midway between the two surfaces
    double separation;     // along the normal; < 0: overlap
    std::uint32_t feature; // which features meet; unchanged from tick to tick while they do
};

inline constexpr std::uint32_t manifold_points_max = 4;

/// The contact of two bodies: up to four points with one normal. Points beyond `count` are not even
/// written, as zeros would cost a third of a contact with a plane.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct Manifold {
    glm::dvec3 normal{0.0, 1.0, 0.0}; // unit, from the first body to the second
    std::array<ContactPoint, manifold_points_max> points;
    std::uint32_t count = 0;

    [[nodiscard]] std::span<const ContactPoint> touching() const { return {points.data(), count}; }
    [[nodiscard]] std::span<ContactPoint> touching() { return {points.data(), count}; }
};

/// The positions of the bodies of a contact.
struct ContactPlaces {
    glm::dvec3 a{0.0};
    glm::dvec3 b{0.0};
};

/// True if at least one point is at most `within` above the surface.
[[nodiscard]] inline bool lies_on(const Manifold& manifold, double within)
{
    for (const ContactPoint& point : manifold.touching()) {
        if (point.separation <= within) return true;
    }
    return false;
}

/// A face, edge or corner of a box: one bit for each of the one, two or three faces that meet
/// there. The bitwise `and` of two features gives the faces that both lie on. The `or` gives the
/// feature that lies on the faces of both.
using FeatureBits = std::uint32_t;

inline constexpr std::uint32_t feature_bits_count = 6;

/// Returns the bit of the face across an axis, 0..2, on its positive or negative side.
[[nodiscard]] constexpr FeatureBits face_bit(int axis, bool is_positive)
{
    return 1U << (2U * static_cast<unsigned>(axis) + (is_positive ? 1U : 0U));
}

/// Returns the features of two boxes that meet, as ContactPoint::feature holds them.
[[nodiscard]] constexpr std::uint32_t feature_pair(FeatureBits first, FeatureBits second)
{
    return first | second << feature_bits_count;
}

/// Returns the feature pair with the boxes exchanged.
[[nodiscard]] constexpr std::uint32_t swapped_feature_pair(std::uint32_t feature)
{
    constexpr std::uint32_t mask = (1U << feature_bits_count) - 1U;
    return feature_pair(feature >> feature_bits_count, feature & mask);
}

/// Returns the core of a round body: a point or a line.
[[nodiscard]] inline OrientedBox core_of(const OrientedBox& shape)
{
    return {shape.centre, shape.axes, shape.half - shape.rounding};
}

/// Returns half the length of a box's shadow along a direction, times the direction's length.
[[nodiscard]] inline double half_projection(const OrientedBox& box, const glm::dvec3& direction)
{
    return box.half.x * std::abs(glm::dot(direction, box.axes[0])) +
           box.half.y * std::abs(glm::dot(direction, box.axes[1])) +
           box.half.z * std::abs(glm::dot(direction, box.axes[2]));
}

/// Returns half the length of any shape's shadow along a unit normal.
[[nodiscard]] inline double half_extent(const OrientedBox& shape, const glm::dvec3& normal)
{
    if (!shape.is_round()) return half_projection(shape, normal);
    return half_projection(core_of(shape), normal) + shape.rounding;
}

/// Returns the greatest distance of a shape's surface from its centre.
[[nodiscard]] inline double outer_radius(const glm::dvec3& half, double rounding)
{
    const glm::dvec3 core = half - rounding;
    return std::sqrt(glm::dot(core, core)) + rounding;
}

/// Returns the smallest half edge of a box.
[[nodiscard]] inline double smallest_half(const OrientedBox& box)
{
    return std::min({box.half.x, box.half.y, box.half.z});
}

/// Returns the length that tolerances are relative to: the smallest half edge of both boxes.
[[nodiscard]] inline double smallest_half(const OrientedBox& a, const OrientedBox& b)
{
    return std::min({a.half.x, a.half.y, a.half.z, b.half.x, b.half.y, b.half.z});
}

} // namespace hapnet::scene
