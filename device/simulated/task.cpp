// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/task.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::device {

namespace {

/// Returns the sum of the four sines that move the hand, in millimetres.
double swings_mm(double seconds)
{
    // Phases in turns; in radians they are 3.09, 3.24, 4.43 and 5.32.
    std::array<double, 4> sines{
        0.484 * seconds + 3.09 / base::two_pi, 0.501 * seconds + 3.24 / base::two_pi,
        0.383 * seconds + 4.43 / base::two_pi, 0.254 * seconds + 5.32 / base::two_pi};
    base::sines_of_turns(sines);
    return 24.0 * sines[0] + 29.0 * sines[1] + 46.7 * sines[2] + 23.2 * sines[3];
}

} // namespace

base::Result<Task> task_named(std::string_view name)
{
    if (const auto task = base::named<Task>(name)) return *task;
    return base::fail(
        fmt::format("unknown task '{}': use {}", name, fmt::join(base::names_of_enum<Task>, ", ")));
}

std::string_view scene_of(Task task, std::size_t peers)
{
    const bool is_for_many = task == Task::t1 || task == Task::t2 || task == Task::t3;
    if (is_for_many && peers > 2) return "carry";
    if (task == Task::t4) return "lift";
    if (task == Task::t5) return "wall";
    if (task == Task::t7) return "carry";
    if (task == Task::t8) return "turning";
    if (task == Task::t9) return "stack-of-three";
    if (task == Task::t10) return "bench";
    return "paper";
}

double path_x(double seconds)
{
    const double t = std::max(0.0, seconds);
    return minimum_jerk(t) * 1e-3 * (22.0 + std::min(52.7, swings_mm(t)));
}

} // namespace hapnet::device
