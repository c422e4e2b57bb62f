// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/metrics/criteria.hpp"

#include <string_view>

namespace hapnet::lab::results {

/// True if an experiment plays what stands against the paper: the sessions of the built-in
/// experiment of that name, judged by the built-in criteria. Seeds, ranges and the choice of
/// algorithms may differ; of hands, tasks, conditions, scene, duration and the like nothing.
[[nodiscard]] bool plays_as_shipped(const experiment::Experiment& experiment,
                                    const metrics::Criteria& criteria, std::string_view built_in);

/// True if an algorithm is the built-in one of its name, with every default.
[[nodiscard]] bool is_built_in(const experiment::NamedAlgorithm& algorithm);

} // namespace hapnet::lab::results
