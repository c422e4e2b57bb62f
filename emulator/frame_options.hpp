// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// Options for frames, in addition to the conditions.
struct FrameOptions {
    bool all_frames = false;
    bool fix_checksums = false;
    bool answers_too_big = false; // for a bridge: reply to senders of packets that `mtu` drops
};

/// The words after the first `--`: commands, separated by `---`.
using TypedCommands = std::vector<std::vector<std::string>>;

/// The greatest number of commands that `between` runs.
inline constexpr std::size_t commands_max = 8;

/// Removes the commands of other programs, which have options of their own, from the command line
/// of `between` and `exec`, and stores them in `commands`. Returns the remaining words.
[[nodiscard]] std::span<char*> take_commands(std::span<char*> words, TypedCommands& commands);

/// Adds the options that the commands for frames have in common, in addition to the options of
/// every run.
void add_frame_options(cli::Command& command, FrameOptions& options);

/// The programs that connect a namespace to the network of the user, without root privileges.
enum class WorldProgram : std::uint8_t { pasta, slirp4netns };
constexpr auto names_of(base::Tag<WorldProgram> /*enum*/)
{
    return base::names("pasta", "slirp4netns");
}

/// These functions add `between`, `exec` with the program that connects it to the network, and
/// `bridge` with its two interfaces.
cli::Command& add_between(cli::Command& program);
cli::Command& add_exec(cli::Command& program, std::optional<WorldProgram>& through);
cli::Command& add_bridge(cli::Command& program, std::string& a, std::string& b,
                         FrameOptions& options);

/// These functions refuse a wrong number of commands, and a command without a word.
[[nodiscard]] base::Result<void> require_several_commands(const TypedCommands& commands);
[[nodiscard]] base::Result<void> require_one_command(const TypedCommands& commands);
/// Refuses two interfaces that are the same.
[[nodiscard]] base::Result<void> require_two_interfaces(const std::string& a, const std::string& b);

} // namespace hapnet::emulator
