// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/space.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::device {

/// A hand's position at a time, seconds from the start of a session.
struct HandMoment {
    double time_s = 0.0;
    base::Position hip;
    bool gripping = false;
    bool docked = false; // no hand holds the stylus

    friend bool operator==(const HandMoment&, const HandMoment&) = default;
};

/// The recorded path of a hand: at least one moment, in the order of time.
using HandTrace = std::vector<HandMoment>;

/// Returns the hand at a time. Between two moments the position is interpolated linearly. Before
/// the first and after the last moment, the hand is at that moment's position and does not grip. A
/// docked stylus stays docked.
[[nodiscard]] HandMoment moment_at(const HandTrace& trace, double seconds);

inline constexpr std::size_t hand_moments_max = 4'000'000;
inline constexpr double hand_reach_max_m = 10.0;

/// Reads CSV. The first line names the columns: time_s, and x_m, y_m and z_m, or hip_x_mm, hip_y_mm
/// and hip_z_mm, as `hapnet-lab export` writes them. Columns gripping and docked (0 or 1) are
/// optional, and other columns are ignored. Times grow from line to line. The error has the form
/// FILE:LINE, with `source` as FILE, and says what was expected.
[[nodiscard]] base::Result<HandTrace> parse_hand_trace(std::string_view text,
                                                       const std::string& source);

/// Returns the path as CSV. parse_hand_trace() restores it to the bit.
[[nodiscard]] std::string print_hand_trace(const HandTrace& trace);

} // namespace hapnet::device
