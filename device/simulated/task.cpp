// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/task.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

constexpr std::array<std::string_view, all_tasks.size()> task_names{"P1", "T1", "T2", "T3",
                                                                    "T4", "T5", "T6"};

} // namespace

base::Result<Task> task_named(std::string_view name)
{
    for (const Task task : all_tasks) {
        if (name_of(task) == name) return task;
    }
    return base::fail(
        fmt::format("'{}' is not a task; known: {}", name, fmt::join(task_names, ", ")));
}

std::string_view name_of(Task task) { return task_names.at(static_cast<std::size_t>(task)); }

std::string_view scene_of(Task task) { return task == Task::t4 ? "lift" : "paper"; }

double path_x(double seconds)
{
    const double t = std::max(0.0, seconds);
    // Phases in turns, of 3.09, 3.24, 4.43 and 5.32 rad.
    std::array<double, 4> sines{0.484 * t + 3.09 / base::two_pi, 0.501 * t + 3.24 / base::two_pi,
                                0.383 * t + 4.43 / base::two_pi, 0.254 * t + 5.32 / base::two_pi};
    base::sines_of_turns(sines);
    const double sum = 24.0 * sines[0] + 29.0 * sines[1] + 46.7 * sines[2] + 23.2 * sines[3];
    return minimum_jerk(t) * 1e-3 * (22.0 + std::min(52.7, sum));
}

} // namespace hapnet::device
