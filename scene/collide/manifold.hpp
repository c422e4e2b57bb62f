// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace hapnet::scene {

/// A box anywhere, its axes the columns of a rotation.
struct OrientedBox {
    glm::dvec3 centre{0.0};
    glm::dmat3 axes{1.0};
    glm::dvec3 half{0.02};
};

/// A point where two bodies touch, or would within the margin.
struct ContactPoint {
    glm::dvec3 position;   // world, midway between the two surfaces
    double separation;     // along the normal; < 0: overlap
    std::uint32_t feature; // which features meet; the same from tick to tick while they do
};

inline constexpr std::uint32_t manifold_points_max = 4;

/// Where two bodies touch: up to four points with one normal. What lies beyond `count` is not even
/// written: zeros would cost a third of a contact with a plane.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct Manifold {
    glm::dvec3 normal{0.0, 1.0, 0.0}; // unit, from the first body to the second
    std::array<ContactPoint, manifold_points_max> points;
    std::uint32_t count = 0;

    [[nodiscard]] std::span<const ContactPoint> touching() const { return {points.data(), count}; }
    [[nodiscard]] std::span<ContactPoint> touching() { return {points.data(), count}; }
};

/// Whether some point is at most so far above the surface.
[[nodiscard]] inline bool lies_on(const Manifold& manifold, double within)
{
    for (const ContactPoint& point : manifold.touching()) {
        if (point.separation <= within) return true;
    }
    return false;
}

} // namespace hapnet::scene
