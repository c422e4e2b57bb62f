// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/parts.hpp"

#include "lab/experiment/grid.hpp"

namespace hapnet::lab::experiment {

std::vector<Experiment> parts_of(const Experiment& experiment)
{
    const auto* plane = std::get_if<ImpairmentGrid>(&experiment.kind);
    if (plane == nullptr) return {experiment};
    std::vector<Experiment> parts;
    for (const GridPoint& point : grid_points(*plane)) {
        Experiment& part = parts.emplace_back(experiment);
        part.kind = ImpairmentGrid{{point.delay}, {point.jitter}, {point.loss}};
    }
    return parts;
}

} // namespace hapnet::lab::experiment
