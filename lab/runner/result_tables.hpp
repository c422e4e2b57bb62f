// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table.hpp"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::lab::runner {

/// Collects tables of results for a folder, part after part. Lines wait in nameless temporary
/// files, so the memory that is used does not grow with the parts.
class ResultTables {
public:
    explicit ResultTables(std::filesystem::path folder) : folder_{std::move(folder)} {}

    /// Appends the rows of a part to the table of the same name. Columns that the table lacks are
    /// added; a row has no value in columns that it lacks. Throws std::system_error.
    void add(const results::Table& part);

    /// Writes each table as CSV and all tables as JSON, with the sessions in a separate file.
    /// Returns the names of the files. Throws std::system_error.
    [[nodiscard]] std::vector<std::string> commit();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    using WaitingLines = std::unique_ptr<std::FILE, Close>;

    struct Table {
        std::string name;
        WaitingLines csv;
        WaitingLines json;
        std::vector<results::Column> columns{};
        /// The first row of each run of rows with equally many cells, and that number of cells.
        std::vector<std::pair<std::size_t, std::size_t>> widths{};
        std::size_t rows = 0;
    };
    using Columns = std::span<const results::Column>;
    /// Receives a stored line, and the columns that it lacks at its end.
    using TakeLine = std::function<void(std::string_view line, Columns missing)>;

    [[nodiscard]] Table& table_named(const std::string& name);
    [[nodiscard]] WaitingLines wait_beside(const std::string& name) const;
    void wait(const WaitingLines& lines, const std::string& text, const std::string& name) const;
    void for_each_line(const Table& table, const WaitingLines& lines, const TakeLine& take) const;
    void commit_csv(const Table& table) const;
    /// Writes the JSON file of the tables of sessions, or that of all other tables. Each folder of
    /// results has a file of the other tables. Returns false, without a file, when the tables of
    /// sessions are requested and there are none.
    [[nodiscard]] bool commit_json(const char* name, bool of_sessions) const;
    [[noreturn]] void refuse(const std::string& name) const;

    std::filesystem::path folder_;
    std::vector<Table> tables_;
};

} // namespace hapnet::lab::runner
