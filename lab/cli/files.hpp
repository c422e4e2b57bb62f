// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/results/session_files.hpp"
#include "lab/results/table.hpp"
#include "proto/base/result.hpp"
#include "proto/record/reader.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab {

/// Reads the JSON object in a file. The error names the file.
[[nodiscard]] base::Result<nlohmann::ordered_json> read_json(const std::string& path);

/// Reads a record. Warns on standard error when its end is missing.
[[nodiscard]] base::Result<record::Record> read_record(const std::string& path);

/// Loads the algorithms that are not built into the program.
[[nodiscard]] base::Result<void> load_own_algorithms(experiment::Experiment& experiment);

/// Creates a folder and its parent folders. An empty path is the current folder. Throws
/// std::system_error that names the folder.
void create_folder(const std::string& path);

/// Reads the files of a session over real UDP from a folder. The error names the file that is
/// missing.
[[nodiscard]] base::Result<results::SessionFiles> read_session_files(const std::string& folder);

/// Fails if the folder has CSV files but no file of that name (results.json, sessions.json or
/// real_time.json) beside them, as an older version of hapnet-lab wrote it.
[[nodiscard]] base::Result<void> require_tables(const std::string& folder, std::string_view name);

/// Writes each table as CSV, and all tables into a file of that name. Throws std::system_error.
void write_result_tables(const std::string& folder, const std::string& name,
                         const std::vector<results::Table>& tables);

} // namespace hapnet::lab
