// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene.hpp"
#include "proto/base/space.hpp"

#include <optional>

namespace hapnet::peer {

/// A hand as the scene sees it: the haptic interface point and whether its owner grips.
struct Hand {
    base::Position hip;
    base::Velocity velocity;
    bool gripping = false;
};

/// Where a sphere and a box overlap.
struct Overlap {
    double depth = 0.0;     // metres, > 0
    glm::dvec3 normal{0.0}; // unit, from the box to the sphere
};

/// Finds how a sphere overlaps a box. Remembers the face through which the centre went in, so
/// that a deep push does not jump to another face.
class SphereBoxContact {
public:
    /// nullopt when they do not overlap.
    [[nodiscard]] std::optional<Overlap> find(const Box& box, base::Position centre, double radius);

private:
    struct Face {
        int axis = 0;
        double sign = 1.0;
    };
    std::optional<Face> entered_;
};

/// The distance from a point to a box's surface; 0 inside.
[[nodiscard]] double distance(const Box& box, base::Position point);

/// Spring and damper: clamp(k depth + c closing speed, 0, force_max), newtons.
[[nodiscard]] double contact_force(const Scene& scene, double depth, double closing_speed);

} // namespace hapnet::peer
