// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/experiment_run.hpp"
#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::lab {

// The exit code: 0 done, 1 stopped before its end, or sessions are missing. The error: bad input.
// Throws std::system_error when the folder cannot be written.

/// Carries out an experiment and writes its folder of results; or the shard of a plan.
[[nodiscard]] base::Result<int> run_experiment(const RunCommand& command);

/// Writes plan.json into a folder.
[[nodiscard]] base::Result<int> plan_experiment(const PlanCommand& planned);

/// The experiment of the plan in a file, which this very program has made. Loads no code of
/// algorithms.
[[nodiscard]] base::Result<LoadedExperiment> load_plan(const std::string& path);

/// Writes the results of a plan from what its shards have played.
[[nodiscard]] base::Result<int> merge(const MergeCommand& command);

} // namespace hapnet::lab
