// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::lab {

/// The result files of one task of the demo, as the programs wrote them.
struct DemoTask {
    nlohmann::ordered_json analysis; // hapnet-lab analyse --json
    nlohmann::ordered_json emulator; // hapnet-emulator --stats
    nlohmann::ordered_json peer;     // hapnet-peer --stats, of the peer with id 1
};

/// The demo of the paper's main job: task P1 and then T3 under 160 ms.
struct DemoRun {
    DemoTask p1;
    DemoTask t3;
};

/// Where and when the demo ran.
struct DemoCircumstances {
    std::string command;
    std::string start; // ISO 8601, UTC
    double wall_time_s = 0.0;
    nlohmann::ordered_json host;
};

/// What the demo measured beside the paper's Table 1: lines of text.
[[nodiscard]] std::string demo_table(const DemoRun& run);

/// Whether P1's mean discrepancy is within 15 % of the paper's 13.79 mm and the emulator of each
/// task has accounted for every datagram.
[[nodiscard]] bool demo_is_met(const DemoRun& run);

/// The manifest of the demo's folder.
[[nodiscard]] nlohmann::ordered_json demo_manifest(const DemoRun& run,
                                                   const DemoCircumstances& circumstances);

} // namespace hapnet::lab
