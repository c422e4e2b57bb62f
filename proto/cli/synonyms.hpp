// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::cli {

// Advice on near misses: words of other tools (tc-netem, toxiproxy, clumsy, iperf), other
// spellings, and typing errors. Each answer gives the name that this project uses.

/// Returns the error for an option that the command does not have: "unknown option --bandwidth: did
/// you mean --rate?".
[[nodiscard]] std::string unknown_option(const Command& command, std::string_view word);

/// Returns the full command that a word probably means; "" if no command is close.
[[nodiscard]] std::string command_meant(const Command& program, std::string_view word);

/// Returns the error for a word that is not a command of the program.
[[nodiscard]] std::string unknown_command(const Command& program, std::string_view word);

/// Returns the name that this program uses for a value of an option, or the value itself if it is
/// not a near miss. The error says that the name does not exist, and gives the closest one.
/// `option` is the option's name, such as "--task".
[[nodiscard]] base::Result<std::string> meant_value(std::string_view option,
                                                    const std::string& value);

} // namespace hapnet::cli
