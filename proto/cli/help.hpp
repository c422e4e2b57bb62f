// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace hapnet::cli {

/// Returns the width of --help: the terminal's on stdout, or 80 columns without a terminal.
[[nodiscard]] std::size_t help_columns();

/// The option that prints files for packages, and its values.
inline constexpr std::string_view generate_word = "--generate";
inline constexpr std::string_view generate_values = "man|bash|zsh|fish";

/// Returns the output of a command's `--help`.
[[nodiscard]] std::string help_text(const Command& command, std::size_t columns);

/// Returns an option as a usage line shows it: "[--for TIME]".
[[nodiscard]] std::string in_usage(const Option& option);

/// "hapnet-lab run EXPERIMENT --out DIR [OPTIONS]": can be pasted and filled in.
[[nodiscard]] std::string usage(const Command& command);

/// Fills the lines of a text up to `columns`, each behind `indent` spaces. Lines that begin with a
/// space stay as they are, except for those of a list ("  name   what it is"), which are folded
/// under their second column.
[[nodiscard]] std::string filled(std::string_view text, std::size_t indent, std::size_t columns);

} // namespace hapnet::cli
