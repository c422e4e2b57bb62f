// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/task.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device {

namespace {

// The scene as a hand must know it: the HIP touches the cube's face 25 mm from its centre.
constexpr double touching_m = 0.025;

// T1: how far the idle hand keeps off, and the path speed over which the turn changes.
constexpr double clearance_m = 0.008;
constexpr double turn_speed_m_per_s = 0.020;

// T3: how far each hand's aim lies inside the cube's face, and how late the right one follows.
// The hand's 200 N/m in series with the contact's 500 N/m make of 4 mm a squeeze of 0.57 N.
constexpr double squeeze_m = 0.004;
constexpr double follower_lag_s = 0.060;
constexpr double carry_pace = 0.5;

constexpr double let_go_m = 0.020;
constexpr double lift_m = 0.045; // above the cube, whose upper face is at 20 mm
constexpr double let_go_s = 0.5;

constexpr std::array<std::pair<std::string_view, Task>, 3> tasks{
    {{"P1", Task::p1}, {"T1", Task::t1}, {"T3", Task::t3}}};

double swing(double amplitude_mm, double hertz, double phase, double seconds)
{
    const double turns = hertz * seconds;
    // Whole turns taken off: the sine's range would end after some days.
    return amplitude_mm * base::sin(base::two_pi * (turns - std::floor(turns)) + phase);
}

double path_speed(double seconds)
{
    constexpr double half_step = 0.005;
    return (path_x(seconds + half_step) - path_x(seconds - half_step)) / (2.0 * half_step);
}

} // namespace

base::Result<Task> task_named(std::string_view name)
{
    for (const auto& [known, task] : tasks) {
        if (known == name) return task;
    }
    return base::fail(fmt::format("'{}' is not a task; known: P1, T1, T3", name));
}

std::string_view name_of(Task task)
{
    for (const auto& [name, known] : tasks) {
        if (known == task) return name;
    }
    return "?";
}

double path_x(double seconds)
{
    const double t = std::max(0.0, seconds);
    const double sines = swing(24.0, 0.484, 3.09, t) + swing(29.0, 0.501, 3.24, t) +
                         swing(46.7, 0.383, 4.43, t) + swing(23.2, 0.254, 5.32, t);
    return minimum_jerk(t) * 1e-3 * (22.0 + std::min(52.7, sines));
}

Intention Script::at(base::TimePoint now) const
{
    const double side = cue_.is_left ? -1.0 : 1.0;
    const double t = base::to_seconds(now - cue_.start);
    const double hands_on = base::to_seconds(cue_.hands_on);
    const bool works = t >= 0.0 && t < hands_on;
    const double let_go = side * let_go_m * minimum_jerk((t - hands_on) / let_go_s);
    const bool carries = task_ == Task::p1 && cue_.is_left;
    // Up and aside: after an outage the two copies may be apart, and aside alone may not be off.
    const double lift = lift_m * minimum_jerk((t - hands_on) / let_go_s);
    return {.target = {{working_x(std::clamp(t, 0.0, hands_on)) + let_go, lift, 0.0}},
            .gripping = carries && works};
}

double Script::working_x(double t) const
{
    const double side = cue_.is_left ? -1.0 : 1.0;
    switch (task_) {
    case Task::p1:
        // The watcher keeps out of the carried cube's way.
        return cue_.is_left ? path_x(t) - touching_m : 0.105;
    case Task::t1: {
        const double rising =
            std::clamp(0.5 + path_speed(t) / (2.0 * turn_speed_m_per_s), 0.0, 1.0);
        const double turn = cue_.is_left ? rising : 1.0 - rising;
        return path_x(t) + side * (touching_m + clearance_m * (1.0 - turn));
    }
    case Task::t3: {
        const double lag = cue_.is_left ? 0.0 : follower_lag_s;
        return path_x(carry_pace * (t - lag)) + side * (touching_m - squeeze_m);
    }
    }
    return 0.0;
}

} // namespace hapnet::device
