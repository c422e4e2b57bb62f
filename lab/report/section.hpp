// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/results.hpp"
#include "proto/page/page.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::report {

using page::Json;
using page::Section;

/// The result files of this name that the page was made from, as paths from the page.
[[nodiscard]] std::vector<std::string> files_named(const results::Results& results,
                                                   std::string_view name);

// The sections. nullopt when the folder has no data for one.

/// The demo's own numbers.
[[nodiscard]] std::optional<Section> demo_section(const results::Results& results);
[[nodiscard]] std::optional<Section> replay_section(const results::Results& results);
/// The data of the replay that the player shows; null where there is none.
[[nodiscard]] Json replays_of(const results::Results& results);
/// Recorded sessions over time, and their analysis.
[[nodiscard]] std::optional<Section> session_section(const results::Results& results);
[[nodiscard]] std::optional<Section> table1_section(const results::Results& results);
[[nodiscard]] std::optional<Section> tasks_section(const results::Results& results);
/// Delay and jitter.
[[nodiscard]] std::optional<Section> fig6a_section(const results::Results& results);
/// Random loss and burst loss.
[[nodiscard]] std::optional<Section> fig6b_section(const results::Results& results);
[[nodiscard]] std::optional<Section> curves_section(const results::Results& results);
[[nodiscard]] std::optional<Section> trust_section(const results::Results& results);
/// Limits by the values of a parameter: readings that were not chosen, the path's own delay.
[[nodiscard]] std::optional<Section> axis_section(const results::Results& results);
/// What a finer step and more seeds buy: precision.csv.
[[nodiscard]] std::optional<Section> precision_section(const results::Results& results);
/// How much of what several parameters were varied over each algorithm bears.
[[nodiscard]] std::optional<Section> points_section(const results::Results& results);
/// Algorithms seed by seed.
[[nodiscard]] std::optional<Section> paired_section(const results::Results& results);
[[nodiscard]] std::optional<Section> fig7_section(const results::Results& results);
[[nodiscard]] std::optional<Section> qos_section(const results::Results& results);
[[nodiscard]] std::optional<Section> real_time_section(const results::Results& results);
[[nodiscard]] std::optional<Section> claims_section(const results::Results& results);
/// What is claimed of an algorithm beyond the paper's: claims.csv.
[[nodiscard]] std::optional<Section> beyond_section(const results::Results& results);
[[nodiscard]] std::optional<Section> runs_section(const results::Results& results);

/// Results that stand against the paper, as texts of a page.
struct Claims {
    std::vector<Json> calibrated;
    std::vector<Json> selected;
    std::vector<Json> by_construction;
    std::vector<Json> met; // predicted
    std::vector<Json> undecided;
    std::vector<Json> missed; // of any class

    [[nodiscard]] bool are_none() const;
};

/// What Table 1 and the worst of the tasks say.
[[nodiscard]] Claims main_claims(const results::Results& results);

} // namespace hapnet::lab::report
