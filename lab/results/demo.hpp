// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/text_table.hpp"
#include "lab/results/manifest.hpp"
#include "lab/results/session_files.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// The demo of the paper's main job: task P1 and then T3 under 160 ms.
struct DemoRun {
    SessionFiles p1;
    SessionFiles t3;
};

/// What the demo measured: beside the paper's Table 1, and of both tasks.
[[nodiscard]] std::vector<records::TextTable> demo_tables(const DemoRun& run);

/// The same as lines of text, and whether the run counts.
[[nodiscard]] std::string demo_table(const DemoRun& run);

/// Whether P1's mean discrepancy is within 15 % of the paper's 13.79 mm and the emulator of each
/// task has accounted for every datagram.
[[nodiscard]] bool demo_is_met(const DemoRun& run);

/// Another task of the demo, of two hands or more: T7 or T8.
struct CircleDemo {
    std::string folder; // that of the task: "t7", "t8"
    SessionFiles files;
};

/// Whether the session counts, in words.
[[nodiscard]] std::string circle_demo_verdict(const CircleDemo& demo);

/// The manifest of the folder in which that of the task is.
[[nodiscard]] nlohmann::ordered_json circle_demo_manifest(const CircleDemo& demo,
                                                          const Circumstances& circumstances);

/// The manifest of the demo's folder.
[[nodiscard]] nlohmann::ordered_json demo_manifest(const DemoRun& run,
                                                   const Circumstances& circumstances);

} // namespace hapnet::lab::results
