// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace hapnet::scene {

/// The face of a box, parallel to the axes, through which a hand's centre went in.
struct EnteredFace {
    std::int8_t axis = -1; // -1: none
    std::int8_t sign = 1;
};

/// A hand as a box sees it: from the box's centre, relative to the box's velocity.
struct Approach {
    glm::dvec3 from_centre{0.0};
    glm::dvec3 velocity{0.0};
    double radius = 0.0;
    double tick = 0.0;
};

/// How a hand meets a box within a tick. The normal holds for the whole tick.
struct Meeting {
    glm::dvec3 normal{0.0}; // unit, from the box to the hand
    int axis = -1;          // of the face; -1: at an edge or a corner, where the normal is oblique
    double depth = 0.0;     // at the start of the tick, along the normal; < 0: still apart
};

/// Whether and where a hand's sphere touches a box at the start of the tick, or may within it.
/// While its centre is outside, the closest point decides; inside, the face through which it
/// came; one that comes inside all of a sudden takes the nearest face. One that is apart meets the
/// face at which it would arrive at its present velocity.
[[nodiscard]] std::optional<Meeting> meet(const Approach& hand, const glm::dvec3& half,
                                          EnteredFace& entered);

} // namespace hapnet::scene
