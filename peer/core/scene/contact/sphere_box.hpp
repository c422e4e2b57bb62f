// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/contact/manifold.hpp"

#include <optional>

namespace hapnet::scene {

/// The face of a box through which a sphere's centre went in.
struct Face {
    std::int8_t axis = 0;
    std::int8_t sign = 1;
};

/// How a sphere and a box overlap, in the world's frame.
struct SphereOverlap {
    double depth = 0.0;     // metres, > 0
    glm::dvec3 normal{0.0}; // unit, from the box to the sphere
    glm::dvec3 point{0.0};  // on the surface of the box, nearest to the centre
};

/// Finds how a sphere overlaps a box, and remembers from which side it came, so that a deep push
/// does not jump to another face, and a sphere that is through the box within one tick is still
/// found in front of it.
class SphereBoxMemory {
public:
    /// nullopt when they do not overlap.
    [[nodiscard]] std::optional<SphereOverlap> find(const OrientedBox& box,
                                                    const glm::dvec3& centre, double radius);
    void forget() { entered_.reset(); }

private:
    std::optional<Face> entered_;
};

/// The distance from a point to a box's surface; 0 inside.
[[nodiscard]] double distance(const OrientedBox& box, const glm::dvec3& point);

} // namespace hapnet::scene
