// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <cstdint>
#include <string>

namespace hapnet::cli {

enum class Shell : std::uint8_t { bash, zsh, fish };

/// Returns the script that completes a program's command line in a shell: its commands, its
/// options, the words that an option takes, and files where an option takes other values.
[[nodiscard]] std::string completion(const Command& program, Shell shell);

} // namespace hapnet::cli
