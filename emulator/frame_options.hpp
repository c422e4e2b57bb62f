// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"

#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// What is said of frames besides the conditions.
struct FrameOptions {
    bool all_frames = false;
    bool fix_checksums = false;
};

/// The words behind the first `--`: a command, or two of them with `---` in between.
struct TypedCommands {
    std::vector<std::string> first;
    std::vector<std::string> second;
    bool has_second = false; // there was a `---`
};

/// Takes these words from the command line of `between` and `exec`, which are commands of other
/// programs with options of their own. What is left is returned.
[[nodiscard]] std::span<char*> take_commands(std::span<char*> words, TypedCommands& commands);

/// Adds what the commands for frames have in common, besides the options of every run.
void add_frame_options(cli::Command& command, FrameOptions& options);

/// Their help texts.
cli::Command& add_between(cli::Command& program);

/// What is wrong with the commands that were typed.
[[nodiscard]] base::Result<void> require_two_commands(const TypedCommands& commands);
[[nodiscard]] base::Result<void> require_one_command(const TypedCommands& commands);

} // namespace hapnet::emulator
