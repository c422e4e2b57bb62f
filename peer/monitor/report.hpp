// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/cli/options.hpp"
#include "peer/loop/journal.hpp"
#include "peer/loop/standing.hpp"
#include "peer/monitor/device_news.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::peer {

/// All that a report is made from.
struct Run {
    const Options& options;
    const Standing& standing;
    const Journal& journal;
    std::string device;
    bool is_record_whole = true;
};

/// The configuration of a peer as records and statistics carry it.
[[nodiscard]] nlohmann::json configuration_json(const Options& options, std::string_view device);

/// What --stats writes at the end, and clients of the control socket are told meanwhile.
[[nodiscard]] nlohmann::json statistics_json(const Run& run);

/// Where the peer is in its life, for clients of the control socket: what it was told, its state,
/// and what there is to say of that to a person.
[[nodiscard]] nlohmann::ordered_json show_json(const Run& run, const WaysBack& ways_back);

/// A few lines for a person.
[[nodiscard]] std::string summary(const Run& run);

/// What a refusal means and what to do about it.
[[nodiscard]] std::string_view words_for(wire::ByeReason reason);

} // namespace hapnet::peer
