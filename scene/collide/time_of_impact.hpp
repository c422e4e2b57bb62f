// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/box_plane.hpp"
#include "scene/collide/manifold.hpp"

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace hapnet::scene {

/// When and on which axis two boxes that keep their orientation first touch.
struct TimeOfImpact {
    double time = 0.0;      // seconds from now
    glm::dvec3 normal{0.0}; // unit, from the first to the second
};

/// The first touch of `b` moving at `relative_velocity` seen from `a`, within [0, time_max];
/// nullopt when there is none, or when they overlap already. Exact for boxes that do not rotate.
[[nodiscard]] std::optional<TimeOfImpact> time_of_impact(const OrientedBox& a, const OrientedBox& b,
                                                         const glm::dvec3& relative_velocity,
                                                         double time_max);

/// How far apart two surfaces are along the normal that keeps them apart most; < 0: they overlap.
struct Gap {
    double distance = 0.0;
    glm::dvec3 normal{0.0, 1.0, 0.0}; // unit, from the first to the second
};
[[nodiscard]] Gap gap_between(const OrientedBox& a, const OrientedBox& b);
[[nodiscard]] Gap gap_between(const PlaneSurface& plane, const OrientedBox& box);

/// A box that moves and turns steadily.
struct SteadyBox {
    glm::dvec3 centre{0.0}; // at time 0
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 velocity{0.0};
    glm::dvec3 spin{0.0};
    glm::dvec3 half{0.02};
    double radius = 0.0;   // of the corners
    double rounding = 0.0; // see OrientedBox

    [[nodiscard]] OrientedBox at(double time) const;
};

/// What to look for: the first time in [from, to] at which a gap has shrunk to `gap`, which may be
/// an overlap; a gap not wider than that by `near` counts.
struct GapSearch {
    double gap = 0.0;
    double near = 0.0;
    double from = 0.0;
    double to = 0.0;
};

/// Until `time` the gap is wider than was asked for.
struct Advanced {
    enum class End : std::uint8_t { clear, reached, unfinished };
    double time = 0.0;
    End end = End::clear;
};

/// Conservative advancement (Mirtich 1996), with rotation: steps of the gap over a bound of the
/// speed at which it can shrink. So it never steps over a touch. `steps` is what it may still take:
/// a look at the two each; it takes off what it took.
[[nodiscard]] Advanced advance_to_gap(const SteadyBox& a, const SteadyBox& b,
                                      const GapSearch& search, std::uint32_t& steps);
[[nodiscard]] Advanced advance_to_gap(const PlaneSurface& plane, const SteadyBox& box,
                                      const GapSearch& search, std::uint32_t& steps);

} // namespace hapnet::scene
