// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/results/file.hpp"
#include "lab/results/table.hpp"

#include <span>
#include <vector>

namespace hapnet::lab::results {

/// The findings of an experiment.
struct Found {
    std::vector<Table> tables;
    std::vector<File> files{}; // files besides the tables: criteria.toml
};

/// Equal results give equal tables. `results` are those of make_jobs(experiment), in that order.
/// The error: sessions that nothing can be calibrated on.
[[nodiscard]] base::Result<Found> find_results(const experiment::Experiment& experiment,
                                               const metrics::Criteria& criteria,
                                               std::span<const experiment::JobResult> results);

} // namespace hapnet::lab::results
