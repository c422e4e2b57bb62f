// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/motion/per_axis.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::scene {

inline constexpr std::uint8_t no_axis = 3;

/// The face of a box, parallel to the axes, through which a hand's centre went in.
struct EnteredFace {
    std::uint8_t axis = no_axis;
    std::int8_t sign = 1;
};

/// A hand as a box sees it: from the box's centre, relative to the box's velocity.
struct Approach {
    PerAxis from_centre{};
    PerAxis velocity{};
    double radius = 0.0;
    double tick = 0.0;
};

/// How a hand meets a box within a tick. The normal holds for the whole tick.
struct Meeting {
    PerAxis normal{};           // unit, from the box to the hand
    std::size_t axis = no_axis; // of the face; none at an edge or a corner: an oblique normal
    double depth = 0.0;         // at the start of the tick, along the normal; < 0: still apart
};

/// Whether and where a hand's sphere touches a box at the start of the tick, or may within it.
/// While its centre is outside, the closest point decides; inside, the face through which it
/// came; one that comes inside all of a sudden takes the nearest face. One that is apart meets the
/// face at which it would arrive at its present velocity.
[[nodiscard]] std::optional<Meeting> meet(const Approach& hand, const PerAxis& half,
                                          EnteredFace& entered);

} // namespace hapnet::scene
