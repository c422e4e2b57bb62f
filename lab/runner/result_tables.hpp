// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/file.hpp"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::lab::runner {

/// A column before those of a table, and what all lines of a part have in it.
struct LeadingCell {
    std::string column;
    std::string value;
};

/// Tables of results on their way to a folder, part after part. Lines wait in files without a name:
/// what is kept in memory does not grow with the parts.
class ResultTables {
public:
    explicit ResultTables(std::filesystem::path folder) : folder_{std::move(folder)} {}

    /// Appends the lines of a CSV to the table of its name. Columns that the table has not yet are
    /// added; one that a line lacks is empty in it. Throws std::system_error.
    void add(const results::File& csv, std::span<const LeadingCell> leading);

    /// Moves all tables to their places, and names them. Throws std::system_error.
    [[nodiscard]] std::vector<std::string> commit();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    using WaitingLines = std::unique_ptr<std::FILE, Close>;

    struct Table {
        std::string name;
        WaitingLines waiting;
        std::vector<std::string> columns{};
        /// From which line on lines have how many cells.
        std::vector<std::pair<std::size_t, std::size_t>> widths{};
        std::size_t lines = 0;
    };

    [[nodiscard]] Table& table_named(const std::string& name);
    [[nodiscard]] WaitingLines wait_beside(const std::string& name) const;
    [[noreturn]] void refuse(const std::string& name) const;

    std::filesystem::path folder_;
    std::vector<Table> tables_;
};

} // namespace hapnet::lab::runner
