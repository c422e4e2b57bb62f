// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/metrics/criteria.hpp"

#include <string_view>

namespace hapnet::lab::results {

/// True if an experiment is comparable with the paper: it plays the sessions of the built-in
/// experiment of that name and is judged by the built-in criteria. Seeds, ranges and the choice of
/// algorithms may differ. Hands, tasks, conditions, scene, duration and the like must be the same.
[[nodiscard]] bool plays_as_shipped(const experiment::Experiment& experiment,
                                    const metrics::Criteria& criteria, std::string_view built_in);

/// True if an algorithm is the built-in one of its name, with all its defaults.
[[nodiscard]] bool is_built_in(const experiment::NamedAlgorithm& algorithm);

} // namespace hapnet::lab::results
