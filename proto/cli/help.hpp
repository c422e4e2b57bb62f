// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace hapnet::cli {

/// Returns the width for --help: that of the terminal at stdout, or 80 columns without a terminal.
[[nodiscard]] std::size_t help_columns();

/// The option that prints files for packages, and its values.
inline constexpr std::string_view generate_word = "--generate";
inline constexpr std::string_view generate_values = "man|bash|zsh|fish";

/// Returns the output of a command's `--help`.
[[nodiscard]] std::string help_text(const Command& command, std::size_t columns);

/// Returns an option in the notation of usage lines: "[--for TIME]".
[[nodiscard]] std::string in_usage(const Option& option);

/// Returns a usage line that can be pasted and filled in: "hapnet-lab run EXPERIMENT --out DIR
/// [OPTIONS]".
[[nodiscard]] std::string usage(const Command& command);

/// Fills the lines of a text up to `columns`, with `indent` spaces before each. Lines that begin
/// with a space are unchanged, except list lines ("  name   what it is"), which continue below
/// their second column.
[[nodiscard]] std::string filled(std::string_view text, std::size_t indent, std::size_t columns);

} // namespace hapnet::cli
