// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"
#include "proto/base/result.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::lab::results {

// Tables of results: the findings of an experiment, in rows of cells. A result folder has each
// table as CSV, for people and other programs, and in results.json, from which reports and
// comparisons are made: docs/formats/experiment.md.

/// A flag, a whole number, a number or a text; std::monostate: no value.
using Cell = std::variant<std::monostate, bool, std::uint64_t, double, std::string>;

/// The files that contain a column: every file; only files in which a row has a value for it; JSON
/// but not CSV.
enum class Stands : std::uint8_t { always, if_filled, in_json };

struct Column {
    std::string key;               // name with its unit, such as "mean_mm"
    std::optional<int> decimals{}; // decimals of a number in CSV; nullopt: as many as needed
    Stands stands = Stands::always;
};

/// Returns the columns of a header line. "mean_mm:3" has three decimals. The column of "scene?" is
/// present only if a row has a value for it, that of "band+" only in JSON.
[[nodiscard]] std::vector<Column> columns_in(std::string_view line);

/// Returns the unit at the end of a key: "mm" of "mean_mm"; empty: it has none.
[[nodiscard]] std::string_view unit_of(std::string_view key);
/// Returns the words of a key without its unit: "paper mean" of "paper_mean_mm".
[[nodiscard]] std::string label_of(std::string_view key);

/// Returns the cell of a value: of an optional, of a name of an enum, or of a number. A number that
/// is not finite gives an empty cell.
template <typename Value>
[[nodiscard]] Cell to_cell(const Value& value)
{
    if constexpr (requires { value.has_value(); }) {
        return value ? to_cell(*value) : Cell{};
    } else if constexpr (base::Named<Value>) {
        return std::string{base::name_of(value)};
    } else if constexpr (std::same_as<Value, bool>) {
        return value;
    } else if constexpr (std::integral<Value>) {
        return static_cast<std::uint64_t>(value);
    } else if constexpr (std::floating_point<Value>) {
        return std::isfinite(value) ? Cell{value} : Cell{};
    } else {
        return std::string{value};
    }
}

struct Table {
    std::string name; // such as "limits" for limits.csv
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows{};

    /// Appends a row with one value for each column.
    template <typename... Values>
    void add(const Values&... values)
    {
        rows.push_back({to_cell(values)...});
    }
    /// Returns the place of a column; nullopt: there is none.
    [[nodiscard]] std::optional<std::size_t> place_of(std::string_view key) const;
    [[nodiscard]] bool is_empty() const { return rows.empty(); }
};

/// A row of a table, with its cells by the keys of the columns. The table must outlive it.
class TableRow {
public:
    TableRow(const Table& table, std::size_t index) : table_{&table}, cells_{&table.rows[index]} {}

    /// Returns the cell of a column; std::monostate where there is no such column.
    [[nodiscard]] const Cell& operator[](std::string_view key) const;
    [[nodiscard]] std::optional<double> number(std::string_view key) const;
    /// Returns the cell's text: a number with as many digits as needed; empty for no value.
    [[nodiscard]] std::string text(std::string_view key) const;

private:
    const Table* table_;
    const std::vector<Cell>* cells_;
};

using Rows = std::vector<TableRow>;
[[nodiscard]] Rows rows_of(const Table& table);

/// Returns a cell as a text: a number with as many digits as needed; "" for no value.
[[nodiscard]] std::string to_text(const Cell& cell);

/// A cell that all rows of a part of a table get before their own cells.
struct LeadingCell {
    std::string key;
    Cell cell;
};
[[nodiscard]] Table with_leading(const std::vector<LeadingCell>& leading, Table table);

/// Appends the rows of a part. Missing columns are added, except optional ones (Stands::if_filled)
/// for which no row has a value. A row has empty cells in columns that it lacks.
void append(Table& table, const Table& part);
/// Returns the table without the optional columns (Stands::if_filled) for which no row has a value.
[[nodiscard]] Table filled(const Table& table);

/// Returns a table of structs with described fields.
[[nodiscard]] Table table_of(std::string name, const base::FieldTable& fields,
                             std::span<const void* const> values);
template <base::Described T>
[[nodiscard]] Table table_of(std::string name, const std::vector<T>& values)
{
    std::vector<const void*> places;
    places.reserve(values.size());
    for (const T& value : values) places.push_back(&value);
    return table_of(std::move(name), base::field_table<T>(), places);
}

} // namespace hapnet::lab::results
