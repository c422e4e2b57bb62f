// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/results/session_rows.hpp"
#include "lab/results/table.hpp"

#include <span>

namespace hapnet::lab::results {

// The tables of an experiment of kind Limits. `results` are those of all its jobs.

/// Limits of each task, and after them of the worst of them. Status and class stand where the
/// experiment plays as the built-in one (plays_as_shipped()).
[[nodiscard]] Table limits_table(const experiment::Experiment& experiment,
                                 const metrics::Criteria& criteria,
                                 std::span<const experiment::JobResult> results);

/// The differences of each algorithm's p50 from that of the first.
[[nodiscard]] Table paired_limits_table(const experiment::Experiment& experiment,
                                        const metrics::Criteria& criteria,
                                        std::span<const experiment::JobResult> results);

/// Every session that a search played.
[[nodiscard]] Table curves_table(const experiment::Experiment& experiment,
                                 const metrics::Criteria& criteria,
                                 std::span<const experiment::JobResult> results);

/// Limits by the order of the filter and by the hands.
[[nodiscard]] Table sensitivity_table(const experiment::Experiment& experiment,
                                      const experiment::Sensitivity& sensitivity,
                                      std::span<const experiment::JobResult> results);

} // namespace hapnet::lab::results
