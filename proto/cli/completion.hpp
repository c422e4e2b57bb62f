// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <cstdint>
#include <string>

namespace hapnet::cli {

enum class Shell : std::uint8_t { bash, zsh, fish };

/// Returns a script with which a shell completes a program's command line. It completes commands,
/// options and the words that an option takes, and file names for options that take other values.
[[nodiscard]] std::string completion(const Command& program, Shell shell);

} // namespace hapnet::cli
