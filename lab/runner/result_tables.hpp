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

/// Tables of results on their way to a folder, part after part. Lines wait in files without a name:
/// what is kept in memory does not grow with the parts.
class ResultTables {
public:
    explicit ResultTables(std::filesystem::path folder) : folder_{std::move(folder)} {}

    /// Appends the rows of a part to the table of its name. Columns that the table has not yet are
    /// added; a row has nothing in those that it lacks. Throws std::system_error.
    void add(const results::Table& part);

    /// Writes each table as CSV and all of them as JSON, sessions in a file of their own. Returns
    /// the names of the files. Throws std::system_error.
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
        /// The first row of each run of rows with equally many cells, and the number of these
        /// cells.
        std::vector<std::pair<std::size_t, std::size_t>> widths{};
        std::size_t rows = 0;
    };
    using Columns = std::span<const results::Column>;
    /// Takes a line that has waited, and the columns that it lacks at its end.
    using TakeLine = std::function<void(std::string_view line, Columns missing)>;

    [[nodiscard]] Table& table_named(const std::string& name);
    [[nodiscard]] WaitingLines wait_beside(const std::string& name) const;
    void wait(const WaitingLines& lines, const std::string& text, const std::string& name) const;
    void for_each_line(const Table& table, const WaitingLines& lines, const TakeLine& take) const;
    void commit_csv(const Table& table) const;
    /// Writes the JSON file of the tables of sessions, or that of all others. Returns false,
    /// without a file, when it is to write tables of sessions and there are none. Each folder of
    /// results has a file of the others.
    [[nodiscard]] bool commit_json(const char* name, bool of_sessions) const;
    [[noreturn]] void refuse(const std::string& name) const;

    std::filesystem::path folder_;
    std::vector<Table> tables_;
};

} // namespace hapnet::lab::runner
