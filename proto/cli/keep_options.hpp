// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/cli/command.hpp"

#include <optional>
#include <string>

namespace hapnet::cli {

/// The span of recent events that a program keeps in memory, and the folder for the files that
/// clients of its control socket ask for.
struct KeepOptions {
    std::optional<base::Duration> span; // nullopt: nothing is kept
    std::string folder;
};

/// Adds --keep and --keep-in, bound to `options`. `what` names, for --help, the data that is kept.
void add_keep(Command& program, KeepOptions& options, const std::string& what);

/// Checks, after parse(), that the options are consistent with each other and with --control.
[[nodiscard]] base::Result<void> check_keep(const KeepOptions& options, bool has_control);

} // namespace hapnet::cli
