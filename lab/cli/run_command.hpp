// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/experiment_run.hpp"
#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::lab {

// These functions return the exit code: 0 when done, 1 when stopped early or when sessions are
// missing. They fail on bad input. They throw std::system_error when the folder cannot be written.

/// Runs an experiment and writes its folder of results, or runs one shard of a plan.
[[nodiscard]] base::Result<int> run_experiment(const RunCommand& command);

/// Writes plan.json into a folder.
[[nodiscard]] base::Result<int> plan_experiment(const PlanCommand& planned);

/// Reads the experiment of the plan in a file. The plan must have been made by this same program.
/// Loads no code of algorithms.
[[nodiscard]] base::Result<LoadedExperiment> load_plan(const std::string& path);

/// Writes the results of a plan from the sessions that its shards have played.
[[nodiscard]] base::Result<int> merge(const MergeCommand& command);

} // namespace hapnet::lab
