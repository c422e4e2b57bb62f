// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/results/rows.hpp"
#include "lab/results/session_rows.hpp"

#include <span>
#include <vector>

namespace hapnet::lab::results {

// The rows of an experiment of kind Limits. `results` are those of all its jobs.

/// Of each task, and after them of the worst of them.
/// Status and class stand where the experiment plays as the built-in one (plays_as_shipped()).
[[nodiscard]] std::vector<LimitRow> make_limit_rows(const experiment::Experiment& experiment,
                                                    const metrics::Criteria& criteria,
                                                    std::span<const experiment::JobResult> results);

/// How p50 of each algorithm differs from that of the first.
[[nodiscard]] std::vector<PairedRow>
make_paired_limit_rows(const experiment::Experiment& experiment,
                       std::span<const experiment::JobResult> results);

/// Every session that a search played.
[[nodiscard]] std::vector<CurveRow> make_curve_rows(const experiment::Experiment& experiment,
                                                    const metrics::Criteria& criteria,
                                                    std::span<const experiment::JobResult> results);

[[nodiscard]] std::vector<SensitivityRow>
make_sensitivity_rows(const experiment::Experiment& experiment,
                      const experiment::Sensitivity& sensitivity,
                      std::span<const experiment::JobResult> results);

} // namespace hapnet::lab::results
