// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/recording.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::lab::hands {

/// The places of a hand, one each millisecond, metres.
using Motion = std::vector<glm::dvec3>;
inline constexpr double motion_rate_hz = 1000.0;

/// Stretches of a track in which the hand was not seen: more than one and a half rows long.
struct Gaps {
    std::uint64_t count = 0;
    double longest_s = 0.0;
    double total_s = 0.0;
    std::size_t line_after_longest = 0; // line in the file of the row after the longest gap
    double begin_of_longest_s = 0.0;    // time on the clock of the recording
};

/// Returns the gaps between the samples from one time to another.
[[nodiscard]] Gaps gaps_in(const Track& track, double from_s, double to_s);

/// The track at `count` times, a millisecond apart from `from_s` on, none of them outside it: cubic
/// Hermite interpolation whose tangents are those of the parabola through three samples
/// (Catmull-Rom, for times that need not be even). Through gaps, too.
[[nodiscard]] Motion resampled(const Track& track, double from_s, std::size_t count);

/// Removes what is above `cutoff_hertz`, without delay: a Butterworth filter of second order, once
/// forward and once backward, and so one of fourth order with zero phase. Its cutoff is raised by
/// 1/(sqrt(2) - 1)^(1/4) = 1.2465, so that both passes together have half the power at
/// `cutoff_hertz` (Winter, Biomechanics and Motor Control of Human Movement, 4th ed. 2009, 2.2.4.4;
/// Robertson, Dowling 2003). At either end the motion is continued by its reflection in its end
/// point.
void smooth(Motion& motion, double cutoff_hertz);

/// The highest speed between two neighbours, m/s.
[[nodiscard]] double speed_max_of(const Motion& motion);

} // namespace hapnet::lab::hands
