// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/trace/rows.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// What was measured of one way, or of a round trip, datagram by datagram.
struct MeasuredWay {
    std::vector<base::Duration> delays; // of a lost one: without meaning
    std::vector<bool> lost;             // as many
    std::size_t reordered = 0;          // arrived after one that was sent later, where it is known
};

/// What a file of measurements says.
struct Measurement {
    std::optional<MeasuredWay> up{}; // nullopt: only the round trip is known
    MeasuredWay down{};              // or the round trip; the losses of both ways are counted here
    std::optional<base::Duration> spacing{}; // from datagram to datagram, on average
};

/// Reads what `ping` has printed, what `probe --csv` has written, or a CSV of delays (see
/// read_trace_rows). Errors name the line.
[[nodiscard]] base::Result<Measurement> read_measurement(std::string_view text,
                                                         const Columns& columns = {});

} // namespace hapnet::emulator::tools
