// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/cli/device_options.hpp"
#include "peer/cli/key_commands.hpp"
#include "peer/cli/options.hpp"
#include "proto/net/program.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace hapnet::peer {

/// The command `hapnet-peer list-devices [--json]`.
struct ListDevicesCommand {
    device::DeviceOptions options;
    bool json = false;
};

/// The command `hapnet-peer doctor [--json] [--key FILE] [--print-udev-rules]`.
struct DoctorCommand {
    std::string hd_library;
    std::optional<std::string> key;
    bool json = false;
};

/// The steps of a self-test, in order.
inline constexpr std::array self_test_steps{"read", "calibrate", "force", "cable"};

/// The command `hapnet-peer self-test --device ... [--skip STEP]... [--json FILE]`.
struct SelfTestCommand {
    DeviceChoice device;
    std::vector<std::string> skip;
    base::Duration read_for{std::chrono::seconds{10}};
    std::optional<std::string> json; // file for the report as JSON
};

/// A command. Options stands for a session.
using Command =
    std::variant<Options, ListDevicesCommand, DoctorCommand, SelfTestCommand, KeyCommand>;

/// Parses the command line. The error names the option, what is wrong with it, and what would be
/// right.
[[nodiscard]] net::CommandLine<Command> parse_command_line(std::span<char*> words);

} // namespace hapnet::peer
