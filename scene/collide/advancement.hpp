// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/steady_box.hpp"
#include "scene/collide/time_of_impact.hpp"

#include <cstdint>

namespace hapnet::scene {

/// The event to look for: the first time in [from, to] at which a gap has shrunk to `gap`. `gap`
/// may be negative, which means an overlap. A gap that is wider by at most `near` counts, too.
struct GapSearch {
    double gap = 0.0;
    double near = 0.0;
    double from = 0.0;
    double to = 0.0;
};

/// The result of a search: the gap is wider than `GapSearch::gap` until `time`.
struct Advanced {
    enum class End : std::uint8_t { clear, reached, unfinished };
    double time = 0.0;
    End end = End::clear;
};

/// Finds the event by conservative advancement (Mirtich 1996), with rotation. Each step is the gap
/// over a bound of the speed at which it can shrink, so that no touch is stepped over. `steps` is
/// the number of steps that the search may still take. The search subtracts the steps that it took.
[[nodiscard]] Advanced advance_to_gap(const SteadyBox& a, const SteadyBox& b,
                                      const GapSearch& search, std::uint32_t& steps);
[[nodiscard]] Advanced advance_to_gap(const PlaneSurface& plane, const SteadyBox& box,
                                      const GapSearch& search, std::uint32_t& steps);

} // namespace hapnet::scene
