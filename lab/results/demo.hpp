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

/// Returns the measurements of the demo: those beside the paper's Table 1, and those of both tasks.
[[nodiscard]] std::vector<records::TextTable> demo_tables(const DemoRun& run);

/// Returns the tables as lines of text, and whether the run counts.
[[nodiscard]] std::string demo_table(const DemoRun& run);

/// True if no row of the tables misses its target: P1's mean discrepancy is within 15 % of the
/// paper's 13.79 mm, the median delay is within 1 ms of 160 ms and the rate of the messages is
/// within 5/s of 1000/s in both tasks and directions, and each emulator has accounted for every
/// datagram.
[[nodiscard]] bool demo_is_met(const DemoRun& run);

/// True if the programs kept time in both tasks.
[[nodiscard]] bool demo_is_valid(const DemoRun& run);

/// Another task of the demo, of two hands or more: T7 or T8.
struct CircleDemo {
    std::string folder; // folder of the task: "t7" or "t8"
    SessionFiles files;
};

/// True if the programs kept time.
[[nodiscard]] bool circle_demo_is_valid(const CircleDemo& demo);

/// A sentence that says whether the run is valid, with the reasons if it is not.
[[nodiscard]] std::string circle_demo_verdict(const CircleDemo& demo);

/// Returns the manifest of the folder that contains the task's folder.
[[nodiscard]] nlohmann::ordered_json circle_demo_manifest(const CircleDemo& demo,
                                                          const Circumstances& circumstances);

/// Returns the manifest of the demo's folder.
[[nodiscard]] nlohmann::ordered_json demo_manifest(const DemoRun& run,
                                                   const Circumstances& circumstances);

} // namespace hapnet::lab::results
