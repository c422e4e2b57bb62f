// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/results/session_rows.hpp"
#include "lab/results/table.hpp"

#include <span>

namespace hapnet::lab::results {

// The tables of an experiment of kind Limits. `results` are those of all its jobs.

/// Returns the limits of each task, and after them those of the worst task. Status and class are
/// filled where the experiment plays like the built-in one (plays_as_shipped()).
[[nodiscard]] Table limits_table(const experiment::Experiment& experiment,
                                 const metrics::Criteria& criteria,
                                 std::span<const experiment::JobResult> results);

/// Returns the differences of each algorithm's p50 from that of the first algorithm.
[[nodiscard]] Table paired_limits_table(const experiment::Experiment& experiment,
                                        const metrics::Criteria& criteria,
                                        std::span<const experiment::JobResult> results);

/// Returns every session that a search played.
[[nodiscard]] Table curves_table(const experiment::Experiment& experiment,
                                 const metrics::Criteria& criteria,
                                 std::span<const experiment::JobResult> results);

/// Returns the limits by the order of the filter and by the hands.
[[nodiscard]] Table sensitivity_table(const experiment::Experiment& experiment,
                                      const experiment::Sensitivity& sensitivity,
                                      std::span<const experiment::JobResult> results);

} // namespace hapnet::lab::results
