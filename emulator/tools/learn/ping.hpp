// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/learn/measurement.hpp"

#include <string_view>

namespace hapnet::emulator::tools {

/// The programs whose lines read_ping() understands, for messages.
inline constexpr std::string_view pings_that_are_read =
    "ping of Linux (iputils, BusyBox), BSD, macOS and Windows, and fping";

/// True if a text has a line in which one of those programs reports an answer.
[[nodiscard]] bool is_ping(std::string_view text);

/// Reads the output of one of those programs, in any language: the programs translate words, but
/// keep the order of the numbers. Questions without an answer count as lost: a missing number, and,
/// for Windows, which prints no numbers, each line between the answers. "time<1ms" counts as 0.5
/// ms. Errors name the line.
[[nodiscard]] base::Result<Measurement> read_ping(std::string_view text);

} // namespace hapnet::emulator::tools
