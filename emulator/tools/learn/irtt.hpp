// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/learn/measurement.hpp"

#include <string_view>

namespace hapnet::emulator::tools {

/// Reads the output of `irtt client -o FILE.json` (irtt-client(1), OUTPUT): one-way delays where
/// the server has added time stamps, and round trips otherwise. If irtt knows in which direction a
/// datagram was lost, the loss counts there. A datagram that was lost on its way up was never sent
/// down. Errors name the line.
[[nodiscard]] base::Result<Measurement> read_irtt(std::string_view text);

} // namespace hapnet::emulator::tools
