// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/base/result.hpp"

#include <string_view>

namespace hapnet::device {

/// What the two simulated hands play together.
enum class Task : std::uint8_t {
    p1, // L holds the cube and carries it along a prescribed path; R watches (Table 1)
    t1, // by turns: L pushes the cube where the path rises, R where it falls
    t3, // both squeeze the cube between them and carry it along the path at half speed
};

/// "P1", "T1", "T3"
[[nodiscard]] base::Result<Task> task_named(std::string_view name);
[[nodiscard]] std::string_view name_of(Task task);

/// The x of the path that the cube is to follow, metres, `seconds` from the start: the sum of
/// four sines, cut off at the static cube, fitted so that the one-way delay of 160 ms alone gives
/// the first column of the paper's Table 1 (13.61 mm mean, 10.68 mm standard deviation, 47.25 mm
/// maximum). Starts at 0 and swings in within the first second.
[[nodiscard]] double path_x(double seconds);

/// Where a hand wants to be, and whether it grips.
struct Intention {
    base::Position target;
    bool gripping = false;
};

/// One hand's part in a task: a pure function of time.
class Script {
public:
    Script(Task task, const Cue& cue) : task_{task}, cue_{cue} {}

    [[nodiscard]] Intention at(base::TimePoint now) const;

private:
    [[nodiscard]] double working_x(double t) const;

    Task task_;
    Cue cue_;
};

} // namespace hapnet::device
