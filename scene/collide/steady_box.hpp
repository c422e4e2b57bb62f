// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <glm/gtc/quaternion.hpp>

namespace hapnet::scene {

/// A box, or a round body, that moves and turns steadily.
struct SteadyBox {
    glm::dvec3 centre{0.0}; // at time 0
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 velocity{0.0};
    glm::dvec3 spin{0.0};
    glm::dvec3 half{0.02};
    double radius = 0.0;   // greatest distance of the surface from `centre`
    double rounding = 0.0; // see OrientedBox
    // A part of a body of several parts, which moves around the body's centre: its place in the
    // body's frame. Then `radius` is measured from that place.
    bool is_part = false;
    glm::dvec3 arm{0.0};
    glm::dmat3 frame{1.0};

    [[nodiscard]] bool is_round() const { return rounding > 0.0; }
    /// Returns the half edges and the radius of a round body's core, or of the box itself.
    [[nodiscard]] glm::dvec3 core_half() const { return half - rounding; }
    [[nodiscard]] double core_radius() const { return radius - rounding; }

    [[nodiscard]] OrientedBox at(double time) const;
    [[nodiscard]] glm::dquat orientation_at(double time) const;
    /// Keeps the velocity and the spin, and changes the start so that at `time` the box is at
    /// `place` and has the orientation `turned`.
    void put(const glm::dvec3& place, const glm::dquat& turned, double time);
};

} // namespace hapnet::scene
