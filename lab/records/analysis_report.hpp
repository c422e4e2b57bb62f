// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/analysis.hpp"
#include "lab/records/text_table.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::lab::records {

/// An analysis for programs: units in the names, null where there is nothing to say.
[[nodiscard]] nlohmann::ordered_json to_json(const Analysis& analysis);

/// An analysis for people, as tables: distances, touch, network, loops.
[[nodiscard]] std::vector<TextTable> tables_of(const Analysis& analysis);

/// How far apart two clocks are; empty when both records were made by one clock.
[[nodiscard]] std::string clock_text(const Clock& clock);

/// An analysis for people, as lines of text: the tables, and whether the run counts.
[[nodiscard]] std::string to_table(const Analysis& analysis);

/// Of more than two: the keys of the first two by their ids, but the discrepancies of the worst
/// pair; `pairs` has all of each pair, `peers` the loop of each.
[[nodiscard]] nlohmann::ordered_json to_json(const CircleAnalysis& circle);
[[nodiscard]] std::vector<TextTable> tables_of(const CircleAnalysis& circle);
[[nodiscard]] std::string to_table(const CircleAnalysis& circle);

} // namespace hapnet::lab::records
