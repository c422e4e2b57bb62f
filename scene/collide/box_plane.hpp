// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

namespace hapnet::scene {

/// A half-space's border, normal out of the solid.
struct PlaneSurface {
    glm::dvec3 normal{0.0, 1.0, 0.0};
    double offset = 0.0;
};

/// The corners of a box below a plane or at most `margin` above it, the deepest four in a fixed
/// order; the normal is the plane's (from the plane to the box).
[[nodiscard]] Manifold collide(const PlaneSurface& plane, const OrientedBox& box, double margin);

} // namespace hapnet::scene
