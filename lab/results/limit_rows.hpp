// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/results/rows.hpp"

#include <span>
#include <vector>

namespace hapnet::lab::results {

// The rows of an experiment of kind Limits. `results` are those of all its jobs.

/// Of each task, and after them of the worst of them.
[[nodiscard]] std::vector<LimitRow> make_limit_rows(const experiment::Experiment& experiment,
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
