// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace hapnet::scene {

// The allowed overlaps of two bodies, in shares of the smallest half edge of the two. Between round
// bodies they are shares of the distance from surface to core, as a thin plate may be deeper in
// those. With each touch in a tick two bodies may overlap by a little more, so that bodies that
// slide on each other or come to rest are not held up and the search ends. The step shrinks as the
// overlap grows, and the overlap hardly exceeds `overlap_max`.
inline constexpr double overlap_step = 0.01;
inline constexpr double overlap_max = 0.5;
inline constexpr double least_step = 0.05; // share of the overlap step that remains in any case
inline constexpr double round_overlap_max = 0.9;
// A gap counts if it is wider than the allowed overlap by at most this share of the next step.
inline constexpr double near_share = 0.1;

/// Returns how much more two bodies with this overlap may overlap at the next touch.
[[nodiscard]] inline double next_overlap(double gap, double smallest)
{
    return overlap_step * smallest * std::max(least_step, 1.0 + gap / (overlap_max * smallest));
}

} // namespace hapnet::scene
