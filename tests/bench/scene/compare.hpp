// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"
#include "tests/bench/scene/scenario.hpp"

namespace hapnet::bench {

/// The result of one subject.
struct Reading {
    std::string subject;
    std::string family;
    double value = 0.0;
};

/// A measured figure, and the requirement on Hapnet's value.
struct Question {
    std::string name;      // of the case
    std::string reference; // "" for none
    std::string metric;
    std::optional<double> target = {}; // for Hapnet's value
    double ratio_min = 0.0;            // the best peer's value over Hapnet's; 0: no target
    Direction direction = Direction::at_most;
};

/// A row for every subject, and, where less is better, one for Hapnet against the best of each
/// family of peers.
[[nodiscard]] std::vector<Row> compare(const Question& question, std::span<const Reading> readings);

/// Measures a scenario at 1 ms with every subject that can run it: the errors, then the cost.
[[nodiscard]] std::vector<Row> judge(const Scenario& scenario, std::span<const Subject> subjects,
                                     double seconds_each);

/// A subject, and its setup for a scenario. Peers with springs of their own appear twice.
struct Entry {
    std::string name; // "bullet native"
    const Subject* subject = nullptr;
    EngineOptions options;
};
[[nodiscard]] std::vector<Entry> entries_of(const Scenario& scenario,
                                            std::span<const Subject> subjects);

/// The p50 of each entry's step, ns.
[[nodiscard]] std::vector<Reading> costs_of(const Course& course, std::span<const Entry> entries,
                                            double seconds_each);

/// The rows as tables in Markdown: a line for every case and metric, a column for every subject.
[[nodiscard]] std::string markdown(std::span<const Row> rows);

/// A list in Markdown of the targets that were missed, and by how much.
[[nodiscard]] std::string misses(std::span<const Row> rows);

} // namespace hapnet::bench
