// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/task.hpp"

#include <cstddef>
#include <span>

namespace hapnet::lab {

/// A stretch of a task in which one hand presses rhythmically against the other's, at one
/// frequency. Seconds from the session's start.
struct Press {
    std::size_t side = 0; // whose hand presses; 0: L
    double hertz = 1.0;
    double begin_s = 0.0;
    double end_s = 0.0;
};

/// When who presses in a task; empty where nobody does.
[[nodiscard]] std::span<const Press> presses_of(device::Task task);

} // namespace hapnet::lab
