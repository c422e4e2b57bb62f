// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/plane.hpp"

#include <algorithm>

namespace hapnet::lab {

std::vector<PlaneCell> cells_of(const Plane& plane)
{
    std::vector<PlaneCell> cells;
    for (const Level delay : plane.delays) {
        for (const Level jitter : plane.jitters) {
            for (const Level loss : plane.losses) cells.push_back({delay, jitter, loss});
        }
    }
    return cells;
}

emulator::Path path_of(const emulator::Path& ground, const PlaneCell& cell)
{
    const auto jittered = impaired(ground, Impairment::jitter, cell.jitter);
    const auto delayed = impaired(jittered, Impairment::delay, std::max(cell.delay, cell.jitter));
    return impaired(delayed, Impairment::random_loss, cell.loss);
}

} // namespace hapnet::lab
