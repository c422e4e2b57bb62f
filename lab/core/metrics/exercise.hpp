// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/task.hpp"

namespace hapnet::lab {

/// From when to when, in seconds from the session's start.
struct Stretch {
    double begin_s = 0.0;
    double end_s = 0.0;
};

/// What a task has its hands do, as far as metrics care. A metric of what they do not do is not
/// taken.
struct Exercise {
    /// One side at a time only receives: its body's vibration counts then. Otherwise both push
    /// all the time, and count all the time.
    bool by_turns = false;
    bool along_path = false; // device::path_x()
    double path_pace = 1.0;  // of it
    Stretch contact{};       // while which both hands are to push; empty when that is nowhere
    bool lifts = false;
};

[[nodiscard]] Exercise exercise_of(device::Task task);

} // namespace hapnet::lab
