// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/task_options.hpp"
#include "proto/base/names.hpp"
#include "proto/base/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hapnet::device {

/// The tasks of the two simulated hands; docs/design/tasks.md describes them.
enum class Task : std::uint8_t {
    p1,  // A holds the cube and carries it along a prescribed path; B watches (Table 1)
    t1,  // by turns: A pushes the cube where the path rises, B where it falls
    t2,  // against each other: one holds, the other presses at 0.5, 1 and 2 Hz; then swapped
    t3,  // both squeeze the cube between them and carry it along the path at half speed
    t4,  // both squeeze the cube, lift it by 50 mm, hold it for 5 s and put it down; twice
    t5,  // both press the cube against the static one, and one lets go suddenly; then the other
    t6,  // A taps the cube at 3 Hz while B rests on its far side
    t7,  // T3 with two to eight hands: alternately from the left and the right, by their ids
    t8,  // two to eight hands turn the cube between them to and fro, each pushing off its middle
    t9,  // A puts the second cube on the first, then B the third on top; others watch
    t10, // A lifts the screwdriver and hands it to B, who puts it down; others watch
};

constexpr auto names_of(base::Tag<Task> /*enum*/)
{
    return base::names("P1", "T1", "T2", "T3", "T4", "T5", "T6", "T7", "T8", "T9", "T10");
}
using base::name_of;

inline constexpr std::array all_tasks{Task::p1, Task::t1, Task::t2, Task::t3, Task::t4, Task::t5,
                                      Task::t6, Task::t7, Task::t8, Task::t9, Task::t10};

/// Returns the task with this name: "P1", "T1", ... "T10".
[[nodiscard]] base::Result<Task> task_named(std::string_view name);

/// Returns the name of the built-in scene for the task. Two hands play T1, T2 or T3 in the paper's
/// scene; more hands play them in a scene with room for all.
[[nodiscard]] std::string_view scene_of(Task task, std::size_t peers = 2);

/// Returns the x of the path that the cube is to follow, metres, `seconds` from the start. It is
/// the sum of four sines, cut off at the static cube, fitted so that the one-way delay of 160 ms
/// alone gives the first column of the paper's Table 1 (13.61 mm mean, 10.68 mm standard deviation,
/// 47.25 mm maximum). The path starts at 0 and reaches its full size within the first second. The
/// hand that carries the cube aims along this path, and so stops where the static cube stops the
/// cube.
[[nodiscard]] double path_x(double seconds);

} // namespace hapnet::device
