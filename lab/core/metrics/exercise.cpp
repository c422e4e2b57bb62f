// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/metrics/exercise.hpp"

#include <array>

namespace hapnet::lab {

namespace {

// As device/simulated/script.cpp has it; hands take a second to close in.
constexpr std::array<Stretch, 1> pressed_in_t2{{{1.5, 26.5}}};
constexpr std::array<Stretch, 1> squeezed_in_t3{{{1.5, 27.0}}};
constexpr std::array<Stretch, 2> squeezed_in_t4{{{1.5, 11.0}, {14.0, 23.5}}};
constexpr std::array<Stretch, 2> lifted_in_t4{{{4.5, 9.0}, {17.0, 21.5}}};
// Between one hand's letting go and the next.
constexpr std::array<Stretch, 4> pressed_in_t5{
    {{5.0, 8.0}, {11.5, 13.0}, {16.5, 18.0}, {21.5, 23.0}}};

} // namespace

Exercise exercise_of(device::Task task)
{
    using device::Task;
    switch (task) {
    case Task::p1:
    case Task::t1: return {.by_turns = true, .along_path = true, .at_wall = true};
    case Task::t2: return {.presses = true, .contact = pressed_in_t2};
    case Task::t3: return {.along_path = true, .path_pace = 0.5, .contact = squeezed_in_t3};
    case Task::t4: return {.contact = squeezed_in_t4, .lifted = lifted_in_t4};
    case Task::t5: return {.at_wall = true, .contact = pressed_in_t5};
    case Task::t6: return {.taps = true};
    }
    return {};
}

} // namespace hapnet::lab
