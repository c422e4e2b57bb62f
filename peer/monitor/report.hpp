// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/cli/options.hpp"
#include "peer/loop/servo_status.hpp"
#include "peer/monitor/device_news.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::peer::monitor {

/// The input of all reports.
struct Run {
    const Options& options;
    const loop::ServoStatus& status;
    std::string device;
    bool is_record_whole = true;
    std::uint64_t rows_lost = 0;  // on their way to the record
    std::uint64_t texts_lost = 0; // messages for a person that nobody took
};

/// The configuration of a peer as records and statistics carry it.
[[nodiscard]] nlohmann::json configuration_json(const Options& options, std::string_view device);

/// The JSON that --stats writes at the end and that clients of the control socket get meanwhile.
[[nodiscard]] nlohmann::json statistics_json(const Run& run);

/// The peer's settings and state for clients of the control socket, and the state in words for a
/// person.
[[nodiscard]] nlohmann::ordered_json show_json(const Run& run, const Recovery& recovery);

/// A few lines for a person.
[[nodiscard]] std::string summary(const Run& run);

/// A refusal in words, with what to do about it.
[[nodiscard]] std::string_view describe(wire::ByeReason reason);

} // namespace hapnet::peer::monitor
