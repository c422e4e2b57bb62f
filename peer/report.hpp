// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/options.hpp"
#include "peer/servo.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::peer {

/// All that a report is made from, after the loop has ended.
struct Run {
    const Options& options;
    const Peer& peer;
    const Servo& servo;
    const Journal& journal;
    const net::UdpSocket& socket;
    std::string device;
    bool is_record_whole = true;
};

/// The configuration of a peer as records and statistics carry it.
[[nodiscard]] nlohmann::json configuration_json(const Options& options, std::string_view device);

/// What --stats writes: one JSON object.
[[nodiscard]] std::string statistics_json(const Run& run);

/// A few lines for a person.
[[nodiscard]] std::string summary(const Run& run);

/// What a refusal means and what to do about it.
[[nodiscard]] std::string_view words_for(wire::ByeReason reason);

} // namespace hapnet::peer
