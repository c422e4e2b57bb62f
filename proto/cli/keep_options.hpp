// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/cli/command.hpp"

#include <optional>
#include <string>

namespace hapnet::cli {

/// The length of a program's last seconds in memory, and the folder for files that its control
/// socket asks for.
struct KeepOptions {
    std::optional<base::Duration> span; // nullopt: nothing is held
    std::string folder;
};

/// Adds --keep and --keep-in, bound to `options`. `what`: that which is held, for --help.
void add_keep(Command& program, KeepOptions& options, const std::string& what);

/// Checks, after parse(), that the options fit each other and --control.
[[nodiscard]] base::Result<void> check_keep(const KeepOptions& options, bool has_control);

} // namespace hapnet::cli
