// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/learn/measurement.hpp"

#include <string_view>

namespace hapnet::emulator::tools {

/// Reads what `irtt client -o FILE.json` has written (irtt-client(1), OUTPUT): the delays of each
/// way where the server has stamped, round trips otherwise. A datagram of which irtt knows on which
/// way it was lost counts there; one that was lost on the way up was never sent down. Errors name
/// the line.
[[nodiscard]] base::Result<Measurement> read_irtt(std::string_view text);

} // namespace hapnet::emulator::tools
