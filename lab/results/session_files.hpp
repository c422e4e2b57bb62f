// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// The result files of one session over real UDP, as the programs wrote them.
struct SessionFiles {
    using Json = nlohmann::ordered_json;

    Json analysis = Json::object(); // output of hapnet-lab analyse --json
    Json emulator = Json::object(); // output of hapnet-emulator --stats
    Json peer = Json::object();     // output of hapnet-peer --stats, of the peer with id 1
    std::vector<Json> others{};     // such output of the peers with ids 2, 3, ..., if present

    /// Returns the reasons why the session does not count, for people; empty: it does.
    [[nodiscard]] std::vector<std::string> invalid_because() const;
};

} // namespace hapnet::lab::results
