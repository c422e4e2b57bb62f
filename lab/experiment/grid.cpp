// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/grid.hpp"

#include <algorithm>

namespace hapnet::lab::experiment {

std::vector<GridPoint> grid_points(const ImpairmentGrid& plane)
{
    std::vector<GridPoint> points;
    for (const ImpairmentLevel delay : plane.delays) {
        for (const ImpairmentLevel jitter : plane.jitters) {
            for (const ImpairmentLevel loss : plane.losses) points.push_back({delay, jitter, loss});
        }
    }
    return points;
}

emulator::Path make_path(const emulator::Path& ground, const GridPoint& point)
{
    const auto jittered = impaired(ground, Impairment::jitter, point.jitter);
    const auto delayed = impaired(jittered, Impairment::delay, std::max(point.delay, point.jitter));
    return impaired(delayed, Impairment::random_loss, point.loss);
}

} // namespace hapnet::lab::experiment
