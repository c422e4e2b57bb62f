// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/statistics.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// Losses that neither a condition nor an end of the path caused: the emulator, or the system under
/// it, had no room. A full queue of a `rate` is not one of them.
inline constexpr std::array own_losses{DropCause::queue_full, DropCause::send_buffer_full,
                                       DropCause::send_failed};

/// Returns the reasons why the traffic of one direction does not represent its conditions:
/// datagrams that the emulator itself sent too late or lost, a few words for each reason. Empty:
/// the direction is valid. `overflowed`: datagrams that the system dropped before the emulator
/// could take them.
[[nodiscard]] std::vector<std::string>
invalid_because(const Statistics& statistics, std::uint64_t overflowed, base::Duration budget);

} // namespace hapnet::emulator
