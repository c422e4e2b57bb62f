// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/distance.hpp"
#include "scene/collide/manifold.hpp"
#include "scene/collide/time_of_impact.hpp"

#include <optional>

// Collisions of two shapes of which at least one is round. A sphere is a point and a capsule is a
// line, each with a rounding. The contact of the surfaces follows from the place where the cores
// are nearest.

namespace hapnet::scene {

/// Returns the distance between the surfaces. < 0: they overlap, and it is minus the shortest way
/// out.
[[nodiscard]] Gap round_gap(const OrientedBox& a, const OrientedBox& b);
[[nodiscard]] Separation round_separation(const OrientedBox& first, const OrientedBox& second);
[[nodiscard]] Separation round_separation(const glm::dvec3& point, const OrientedBox& shape);

/// Finds where two shapes touch or are up to `margin` apart. There is one point, or two where a
/// capsule lies along a face, an edge or another capsule, up to about a degree off it.
[[nodiscard]] Manifold round_manifold(const OrientedBox& a, const OrientedBox& b, double margin);

/// As time_of_impact(), by Newton's method, which converges because the distance of two shapes that
/// do not turn is convex.
[[nodiscard]] std::optional<TimeOfImpact> round_time_of_impact(const OrientedBox& a,
                                                               const OrientedBox& b,
                                                               const glm::dvec3& relative_velocity,
                                                               double time_max);

[[nodiscard]] std::optional<RayEntry> enter_round(const OrientedBox& shape,
                                                  const glm::dvec3& origin,
                                                  const glm::dvec3& direction, double length);

} // namespace hapnet::scene
