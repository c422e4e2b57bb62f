// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/exercise.hpp"

#include <array>

namespace hapnet::lab::metrics {

namespace {

// The values come from device/simulated/script.cpp and from the scenes: docs/design/tasks.md.
constexpr std::array<Stretch, 1> pressed_in_t2{{{2.0, 26.75}}};
constexpr std::array<Stretch, 1> squeezed_in_t3{{{1.5, 27.0}}};
constexpr std::array<Stretch, 1> squeezed_in_t4{{{2.5, 15.0}}};
constexpr std::array<Stretch, 1> lifted_in_t4{{{8.5, 13.0}}};
// The times between the return of one hand and the release of the other.
constexpr std::array<Stretch, 4> pressed_in_t5{
    {{2.5, 5.0}, {8.5, 10.0}, {13.5, 15.0}, {18.5, 20.0}}};

constexpr double stop_on_path_m = 0.0747;
constexpr double stop_in_t5_m = 0.001;

} // namespace

Exercise exercise_of(device::Task task)
{
    using device::Task;
    switch (task) {
    case Task::p1:
    case Task::t1: return {.by_turns = true, .along_path = true, .stopped_at_m = stop_on_path_m};
    case Task::t2: return {.presses = true, .contact = pressed_in_t2};
    case Task::t3:
    case Task::t7: return {.along_path = true, .path_pace = 0.5, .contact = squeezed_in_t3};
    case Task::t4: return {.contact = squeezed_in_t4, .lifted = lifted_in_t4};
    case Task::t5: return {.stopped_at_m = stop_in_t5_m, .contact = pressed_in_t5};
    case Task::t6: return {.taps = true};
    case Task::t8:
    case Task::t9:
    case Task::t10: return {};
    }
    return {};
}

} // namespace hapnet::lab::metrics
