// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/steady_box.hpp"
#include "scene/collide/time_of_impact.hpp"

#include <cstdint>

namespace hapnet::scene {

/// The event to look for: the first time in [from, to] at which a gap has shrunk to `gap`, which
/// may be an overlap; a gap not wider than that by `near` counts.
struct GapSearch {
    double gap = 0.0;
    double near = 0.0;
    double from = 0.0;
    double to = 0.0;
};

/// The gap is wider than was asked for until `time`.
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
