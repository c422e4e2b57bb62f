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

/// The object that a file holds. The error names the file.
[[nodiscard]] base::Result<nlohmann::ordered_json> read_json(const std::string& path);

/// Reads a record. Says so on standard error when its end is missing.
[[nodiscard]] base::Result<record::Record> read_record(const std::string& path);

/// Loads the algorithms that are no part of the program.
[[nodiscard]] base::Result<void> load_own_algorithms(experiment::Experiment& experiment);

/// Creates a folder and those above it; the empty path is the one where this runs. Throws
/// std::system_error naming the folder.
void create_folder(const std::string& path);

/// Reads the files of a session over real UDP from a folder. The error names the file that is
/// missing.
[[nodiscard]] base::Result<results::SessionFiles> read_session_files(const std::string& folder);

/// The error: the folder has CSV and not the file of that name beside it, results.json,
/// sessions.json or real_time.json, as an older version of hapnet-lab wrote it.
[[nodiscard]] base::Result<void> require_tables(const std::string& folder, std::string_view name);

/// Writes each table as CSV, and all of them into a file of that name. Throws std::system_error.
void write_result_tables(const std::string& folder, const std::string& name,
                         const std::vector<results::Table>& tables);

} // namespace hapnet::lab
