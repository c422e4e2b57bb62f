// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/trace/rows.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// The measurements of one direction, or of a round trip, datagram by datagram.
struct MeasuredWay {
    std::vector<std::optional<base::Duration>> delays{}; // nullopt: lost, or not known
    std::vector<bool> lost{};                            // one for each of `delays`
    std::size_t reordered = 0;               // arrived after a datagram sent later, as far as known
    std::optional<base::Duration> spacing{}; // mean time from datagram to datagram

    void add(std::optional<base::Duration> delay, bool is_lost)
    {
        delays.push_back(is_lost ? std::nullopt : delay);
        lost.push_back(is_lost);
    }
};

/// A measurement: a round trip, one direction, or both directions. At least one of them is set.
struct Measurement {
    std::optional<MeasuredWay> round_trip{};
    std::optional<MeasuredWay> up{};
    std::optional<MeasuredWay> down{};
    /// True if the direction in which a datagram was lost is not known. All losses are then counted
    /// in down.
    bool mixes_losses = false;
    std::vector<std::string> remarks{}; // about the input, for people
};

/// A file of measurements. The name is for messages.
struct MeasuredFile {
    std::string name;
    std::string bytes;
};

/// Reads the output of ping (see read_ping), of `probe --csv`, or of irtt as JSON, or a table of
/// delays (see read_trace_rows). Errors name the line.
[[nodiscard]] base::Result<Measurement> read_measurement(std::string_view text,
                                                         const base::Columns& columns = {});

/// Reads several files as one measurement of the same path: series follow one another in the order
/// of the files. Of captures (pcap, pcapng) there may be one or two; see measure_capture(). Errors
/// begin with the name of the file.
[[nodiscard]] base::Result<Measurement> read_measurements(std::span<const MeasuredFile> files,
                                                          const base::Columns& columns = {});

/// Gives both directions the same least delay if the ends of a path have different clocks, which a
/// negative delay shows. One direction alone gets the least delay 0. Adds a remark in these cases.
void settle_clocks(Measurement& measurement);

} // namespace hapnet::emulator::tools
