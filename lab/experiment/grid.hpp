// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"

#include <vector>

namespace hapnet::lab::experiment {

/// One point of the plane of delay, jitter and loss.
struct GridPoint {
    ImpairmentLevel delay{};
    ImpairmentLevel jitter{};
    ImpairmentLevel loss{};
};

/// Returns all points of the grid. Loss varies fastest, then jitter, then delay.
[[nodiscard]] std::vector<GridPoint> grid_points(const ImpairmentGrid& plane);

/// Returns the conditions of a point. The mean delay is `delay`, or the jitter if that is greater,
/// since no message can arrive before it was sent.
[[nodiscard]] emulator::Path make_path(const emulator::Path& ground, const GridPoint& point);

} // namespace hapnet::lab::experiment
