// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/task_options.hpp"

#include <array>
#include <cmath>

namespace hapnet::device {

/// For T2: from `begin_s` to `end_s`, seconds from the session's start, one hand's aim oscillates
/// as amplitude * sin(2 pi hertz (t - begin)) into the cube, in whole cycles, while the other hand
/// holds. The first cycle is transient: measure from begin_s + 1 / hertz.
struct PressInterval {
    double begin_s = 0.0;
    double end_s = 0.0;
    bool left_presses = true;
    double hertz = 0.0;
};

/// The whole of T2: A presses at 0.5, 1 and 2 Hz, then B does. It needs 26.75 s with hands on.
inline constexpr std::array<PressInterval, 6> press_schedule{{{2.0, 8.0, true, 0.5},
                                                              {8.0, 12.0, true, 1.0},
                                                              {12.0, 14.0, true, 2.0},
                                                              {14.75, 20.75, false, 0.5},
                                                              {20.75, 24.75, false, 1.0},
                                                              {24.75, 26.75, false, 2.0}}};

/// Returns the schedule for the options: all intervals at one frequency, each cut to whole cycles,
/// which may be none.
[[nodiscard]] inline std::array<PressInterval, 6> press_schedule_of(const TaskOptions& options)
{
    std::array<PressInterval, 6> schedule = press_schedule;
    if (!options.press_hertz) return schedule;
    for (PressInterval& interval : schedule) {
        interval.hertz = *options.press_hertz;
        const double cycles = std::floor((interval.end_s - interval.begin_s) * interval.hertz);
        interval.end_s = interval.begin_s + cycles / interval.hertz;
    }
    return schedule;
}

} // namespace hapnet::device
