// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/task.hpp"

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The beginning and the end, in seconds from the session's start.
struct Stretch {
    double begin_s = 0.0;
    double end_s = 0.0;
};

/// The actions of a task's hands that metrics depend on, with the task's default options. A metric
/// is not measured in a task without its action.
struct Exercise {
    /// True if the sides take turns: the vibration of a side's body counts only while the side
    /// follows. Otherwise both sides push, and count all the time.
    bool by_turns = false;
    bool along_path = false;              // the body is to follow device::path_x()
    double path_pace = 1.0;               // pace along that path: 1 is that of device::path_x()
    bool presses = false;                 // hands press as device::press_schedule says
    bool taps = false;                    // A taps while everything else rests
    std::optional<double> stopped_at_m{}; // x of the body at which the static cube stops it
    std::span<const Stretch> contact{};   // times in which both hands are to push
    std::span<const Stretch> lifted{};    // times in which the body is to be up
};

[[nodiscard]] Exercise exercise_of(device::Task task);

} // namespace hapnet::lab::metrics
