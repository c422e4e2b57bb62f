// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::lab {

/// Carries out an experiment and writes its folder of results. The exit code: 0 done, 1 stopped
/// before its end. The error: bad input. Throws std::system_error when the folder cannot be
/// written.
[[nodiscard]] base::Result<int> run_experiment(const RunCommand& command);

} // namespace hapnet::lab
