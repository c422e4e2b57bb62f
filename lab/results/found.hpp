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

/// Computes the findings of an experiment. Equal results give equal tables. `results` are those of
/// make_jobs(experiment), in that order. Fails when no session can serve for a calibration.
[[nodiscard]] base::Result<Found> find_results(const experiment::Experiment& experiment,
                                               const metrics::Criteria& criteria,
                                               std::span<const experiment::JobResult> results);

} // namespace hapnet::lab::results
