// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"

#include <string>

namespace hapnet::lab {

/// Adds `fit hands` to the program. Its options are stored in `fit`.
cli::Command& add_fit(cli::Command& program, FitHandsCommand& fit);

/// Fits simulated hands to recorded ones. Writes their trials, the trials that judge them, the fit
/// and an experiment that plays both. Returns a report, in lines. Names each subject on standard
/// error. Fails on bad input. Throws std::system_error when a file cannot be written.
[[nodiscard]] base::Result<std::string> fit_hands(const FitHandsCommand& command);

} // namespace hapnet::lab
