// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"

#include <vector>

namespace hapnet::lab {

/// One point of the plane of delay, jitter and loss.
struct PlaneCell {
    Level delay{};
    Level jitter{};
    Level loss{};
};

/// All of them: loss runs first, then jitter, then delay.
[[nodiscard]] std::vector<PlaneCell> cells_of(const Plane& plane);

/// The conditions of a cell. The mean delay is `delay`, or the jitter where that is more: nothing
/// leaves before it came.
[[nodiscard]] emulator::Path path_of(const emulator::Path& ground, const PlaneCell& cell);

} // namespace hapnet::lab
