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
/// of an action that the task does not have is not measured.
struct Exercise {
    /// True if only one side at a time receives: its body's vibration counts then. Otherwise both
    /// push, and count all the time.
    bool by_turns = false;
    bool along_path = false;              // device::path_x()
    double path_pace = 1.0;               // of it
    bool presses = false;                 // as device::press_schedule says
    bool taps = false;                    // A taps while all rests
    std::optional<double> stopped_at_m{}; // x of the body at which the static cube stops it
    std::span<const Stretch> contact{};   // while both hands are to push
    std::span<const Stretch> lifted{};    // while the body is to be up
};

[[nodiscard]] Exercise exercise_of(device::Task task);

} // namespace hapnet::lab::metrics
