// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/tools/learn/measurement.hpp"

#include <string>
#include <vector>

namespace hapnet::emulator::tools {

/// A profile that does to datagrams what was measured, and how sure that is.
struct Lesson {
    Profile profile;
    std::vector<std::string> remarks; // for people, one a line
    std::vector<std::string> plots;   // for a terminal, of several lines each
};

/// Finds the laws of a measurement: delays, their correlation in time, losses, reordering. A law
/// of delays is rejected when a right one would look so one time in a thousand; if all are, the
/// nearest is taken, and a remark says so. The error: nothing arrived.
[[nodiscard]] base::Result<Lesson> learn(const Measurement& measurement);

/// The profile as TOML, with the remarks as comments before it.
[[nodiscard]] std::string to_text(const Lesson& lesson);

} // namespace hapnet::emulator::tools
