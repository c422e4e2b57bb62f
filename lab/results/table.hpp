// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/file.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::lab::report {

/// The rows of a CSV file (RFC 4180): one header line, then as many cells a line. Errors are
/// "FILE:LINE: " and what was expected.
struct Table {
    struct Line {
        std::size_t number = 0; // in the file, from 1
        std::vector<std::string> cells;
    };

    std::string path;
    std::vector<std::string> columns;
    std::vector<Line> lines;
};

[[nodiscard]] base::Result<Table> read_table(const File& file);

/// Reads one line of a table, cell by cell, by the names of the columns: what the caller does not
/// ask for is nobody's business. Remembers the first trouble; what is asked after it is empty.
class Row {
public:
    Row(const Table& table, const Table::Line& line) : table_{table}, line_{line} {}

    [[nodiscard]] std::string text(std::string_view column);
    /// Finite.
    [[nodiscard]] double number(std::string_view column);
    /// An empty cell is none.
    [[nodiscard]] std::optional<double> number_if_any(std::string_view column);
    /// "true", "false"
    [[nodiscard]] bool flag(std::string_view column);
    /// One of these words.
    template <typename Value>
    [[nodiscard]] Value one_of(std::string_view column,
                               std::span<const std::pair<std::string_view, Value>> words);

    [[nodiscard]] const std::optional<std::string>& trouble() const { return trouble_; }

private:
    /// nullptr once there was trouble.
    const std::string* cell(std::string_view column);
    void expect(std::string_view column, std::string_view what, std::string_view found);
    void complain(std::size_t line, std::string what);

    const Table& table_;
    const Table::Line& line_;
    std::optional<std::string> trouble_;
};

template <typename Value>
Value Row::one_of(std::string_view column,
                  std::span<const std::pair<std::string_view, Value>> words)
{
    const std::string* found = cell(column);
    if (found == nullptr) return Value{};
    std::string possible;
    for (const auto& [word, value] : words) {
        if (*found == word) return value;
        possible += (possible.empty() ? "'" : ", '") + std::string{word} + "'";
    }
    expect(column, "one of " + possible, *found);
    return Value{};
}

/// All rows of a file, each by `read`.
template <typename Value>
[[nodiscard]] base::Result<std::vector<Value>> rows_of(const File& file, Value (*read)(Row&))
{
    const auto table = read_table(file);
    if (!table) return tl::unexpected{table.error()};
    std::vector<Value> values;
    for (const Table::Line& line : table->lines) {
        Row row{*table, line};
        values.push_back(read(row));
        if (row.trouble()) return base::fail(*row.trouble());
    }
    return values;
}

} // namespace hapnet::lab::report
