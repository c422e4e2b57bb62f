// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/recording.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::hands {

/// The positions of a hand, one for each millisecond, metres.
using Motion = std::vector<glm::dvec3>;
inline constexpr double motion_rate_hz = 1000.0;

/// The gaps of a track: times of more than one and a half rows in which the hand was not seen.
struct Gaps {
    std::uint64_t count = 0;
    double longest_s = 0.0;
    double total_s = 0.0;
    std::size_t line_after_longest = 0; // line in the file of the row after the longest gap
    double begin_of_longest_s = 0.0;    // time on the clock of the recording
};

/// Returns the gaps between the samples from one time to another.
[[nodiscard]] Gaps gaps_in(const Track& track, double from_s, double to_s);

/// Returns the track at `count` times, a millisecond apart, beginning at `from_s`. None of them may
/// be outside the track. The interpolation is cubic Hermite, with the tangents of the parabola
/// through three samples (Catmull-Rom, for uneven times). It also bridges gaps.
[[nodiscard]] Motion resampled(const Track& track, double from_s, std::size_t count);

/// Removes frequencies above `cutoff_hertz`, without delay. A Butterworth filter of second order
/// runs once forward and once backward, which gives fourth order with zero phase. Its cutoff is
/// raised by 1/(sqrt(2) - 1)^(1/4) = 1.2465, so that both passes together have half the power at
/// `cutoff_hertz` (Winter, Biomechanics and Motor Control of Human Movement, 4th ed. 2009, 2.2.4.4;
/// Robertson, Dowling 2003). At either end the motion is continued by its reflection in its end
/// point.
void smooth(Motion& motion, double cutoff_hertz);

/// Returns the highest speed between two neighbouring positions, m/s.
[[nodiscard]] double speed_max_of(const Motion& motion);

/// Returns the motion as CSV for device::parse_hand_trace(), in whole nanometres.
[[nodiscard]] std::string script_text(const Motion& motion);

} // namespace hapnet::lab::hands
