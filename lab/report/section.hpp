// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/report/drawing.hpp"
#include "lab/results/results.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::report {

/// A plot that also becomes a file of its own.
struct Figure {
    std::string name; // figures/NAME.svg
    std::string svg;
    nlohmann::ordered_json data{}; // that web/page/report draws it from; null: it stays as it is
    std::string csv{};             // figures/NAME.csv; empty: its numbers stand in a result file
};

/// A part of the page.
struct Section {
    std::string id;
    std::string title; // text
    std::string html{};
    std::vector<Figure> figures{};
    std::string sources{}; // links to the files whose rows the next figures show, as HTML

    /// A figure in the page and as a file; the caption is HTML. Below it stand the sources.
    void add_figure(std::string name, std::string svg, std::string_view caption);
    /// The same, drawn by the page's script. Without sources it gets a CSV file of its own.
    void add_figure(std::string name, Drawing drawing, std::string_view caption);
    /// As add_figure(), but its HTML is returned, to stand elsewhere in the section.
    [[nodiscard]] std::string keep_figure(std::string name, Drawing drawing,
                                          std::string_view caption);
};

/// Links to the result files of this name that the page was made from, as HTML; empty: none.
[[nodiscard]] std::string links_to(const results::Results& results, std::string_view name);

// The sections. nullopt when the folder has no data for one.

/// The demo's own numbers.
[[nodiscard]] std::optional<Section> demo_section(const results::Results& results);
[[nodiscard]] std::optional<Section> replay_section(const results::Results& results);
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

/// Results that stand against the paper, as lines of HTML.
struct Claims {
    std::vector<std::string> calibrated;
    std::vector<std::string> selected;
    std::vector<std::string> by_construction;
    std::vector<std::string> met; // predicted
    std::vector<std::string> undecided;
    std::vector<std::string> missed; // of any class

    [[nodiscard]] bool are_none() const;
};

/// What Table 1 and the worst of the tasks say.
[[nodiscard]] Claims main_claims(const results::Results& results);

} // namespace hapnet::lab::report
