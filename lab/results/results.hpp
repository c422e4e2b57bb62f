// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/records/analysis.hpp"
#include "lab/records/curves.hpp"
#include "lab/results/demo.hpp"
#include "lab/results/file.hpp"
#include "lab/results/replay.hpp"
#include "lab/results/table.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::results {

/// The origin of some of the results: a manifest.json.
struct Run {
    std::string folder; // folder of the manifest, as the path of the file says
    nlohmann::ordered_json manifest;
    std::optional<metrics::Criteria> criteria; // criteria of the run; nullopt: not stated

    [[nodiscard]] bool is_valid() const;
};

/// The record of one of the peers of a session.
struct RecordedPeer {
    std::int64_t id = 0;
    nlohmann::json config; // configuration in the peer's record
    std::string file{};    // path of the record from the page; empty: unknown
};

/// A session that two peers have recorded.
struct RecordedSession {
    std::string name;      // name of the records' folder; the task if there is one session
    std::string task;      // empty: the record does not say
    std::string algorithm; // empty: the record does not say
    RecordedPeer a;
    RecordedPeer b;
    base::Duration length{};
    records::Analysis analysis;
    records::SessionCurves curves;
};

/// A table that is stored as CSV.
struct TableFile {
    std::string table; // name of the table among the results
    std::string path;  // path from the folder of the page
};

/// The contents of a result folder and its subfolders, joined.
struct Results {
    std::vector<Run> runs;
    /// `sessions` is the table of Table 1's sessions, `claim_sessions` that of the claims'
    /// sessions.
    std::vector<Table> tables;
    std::vector<Replay> replays;
    std::vector<RecordedSession> sessions;
    std::optional<DemoRun> demo;
    std::vector<TableFile> files;

    /// Returns the table of that name, or an empty one where there is none.
    [[nodiscard]] const Table& table(std::string_view name) const;
    [[nodiscard]] Rows rows(std::string_view name) const { return rows_of(table(name)); }
    /// Returns the CSV files of a table, as paths from the page.
    [[nodiscard]] std::vector<std::string> files_of(std::string_view name) const;
    /// Returns the criteria by which all runs judged; nullopt when the runs do not state them, or
    /// differ.
    [[nodiscard]] std::optional<metrics::Criteria> criteria() const;
};

/// A record and its path.
struct RecordFile {
    const record::Record* record = nullptr;
    std::string path{}; // path from the page; empty: unknown
};

/// Adds the session that two or more records share: every pair of them, and one replay of all sides
/// in the form for the player. In every pair the peer with the lower id is A. The error names the
/// two, by their ids in order, that cannot be compared.
[[nodiscard]] base::Result<void> add_session(Results& results, const std::string& name,
                                             std::span<const RecordFile> records);
[[nodiscard]] base::Result<void> add_session(Results& results, const std::string& name,
                                             const record::Record& a, const record::Record& b);

/// Reads the manifests and tables of a result folder and of its subfolders, in any order. Errors
/// begin with "FILE:". Two results that exclude each other, such as two rows of Table 1 for one
/// algorithm, are an error.
[[nodiscard]] base::Result<Results> read_results(std::span<const File> files);

} // namespace hapnet::lab::results
