// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table.hpp"

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::results {

// Tables as the texts of files: CSV, and the JSON of docs/formats/experiment.md,
//     {"version": 1, "tables": {"limits": {"columns": [...], "rows": [[...], ...]}, ...}}

inline constexpr const char* tables_name = "results.json";
/// The file of the single sessions of an experiment, of which there can be a million.
inline constexpr const char* sessions_name = "sessions.json";
/// The file of the sessions in real time beside the results of an experiment.
inline constexpr const char* real_time_name = "real_time.json";

// The parts of the texts, in their order.

[[nodiscard]] std::string csv_header(const std::vector<Column>& columns);
/// Returns a row such as `1,2.500,"a, b"`, without a line end.
[[nodiscard]] std::string csv_line(const Table& table, std::size_t row);
/// Returns a row such as `1,2.5,"a, b"`, without the brackets.
[[nodiscard]] std::string json_line(const Table& table, std::size_t row);

inline constexpr std::string_view json_begin = "{\"version\":1,\"tables\":{";
inline constexpr std::string_view json_end = "}}\n";
/// Returns the head `"limits":{"columns":[...],"rows":[`. `]}` closes it.
[[nodiscard]] std::string json_head(const std::string& name, const std::vector<Column>& columns);

// The texts of files, without optional columns (Stands::if_filled) for which no row has a value.

[[nodiscard]] std::string csv_text(const Table& table);
[[nodiscard]] std::string json_text(std::span<const Table> tables);
/// Returns the cells of the CSV in columns of equal width, for people.
[[nodiscard]] std::string aligned_text(const Table& table);

/// Returns the rows as objects by the keys of the columns.
[[nodiscard]] nlohmann::ordered_json json_objects(const Table& table);

/// Reads the tables of a JSON file. The error names the file and what is wrong in it.
[[nodiscard]] base::Result<std::vector<Table>> read_tables(std::string_view text,
                                                           const std::string& path);

} // namespace hapnet::lab::results
