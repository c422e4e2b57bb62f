// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::base {

// Tables of comma-separated values (RFC 4180): one header line, then lines with as many cells. The
// columns of a struct are its fields (fields.hpp), whose keys contain their units.

/// The lines of a table, unparsed.
struct CsvTable {
    struct Line {
        std::size_t number = 0; // number of the line in the text, from 1
        std::vector<std::string> cells;
    };

    std::string path;
    std::vector<std::string> columns;
    std::vector<Line> lines;
};

/// Splits a text into the lines of a table. Errors begin with "PATH:LINE: ", where PATH is `path`.
[[nodiscard]] Result<CsvTable> parse_csv(std::string_view text, const std::string& path);

/// Returns a cell as it is written in a line: in quotes if it needs them.
[[nodiscard]] std::string csv_quoted(std::string_view cell);

/// A format that writes a number with a fixed number of decimals in CSV. Elsewhere it is the same
/// as Number.
struct Decimals : Number {
    int decimals = 0;

    explicit constexpr Decimals(int count) : decimals{count} {}
};

/// The format of a column that the table omits if no line has a value in it. Its member is an
/// optional.
template <typename Format>
struct Spare : Format {
    static constexpr bool is_spare = true;
};

// Values as cells. The cell is empty for a number that is not finite and for an optional without a
// value.

[[nodiscard]] std::string cell_of(const ValueKind& kind, const void* value);
/// Reads a cell into `value`. Returns false when the cell holds no such value.
[[nodiscard]] bool read_cell(const ValueKind& kind, std::string_view cell, void* value);

template <typename T>
[[nodiscard]] std::string cell_of(const T& value)
{
    static_assert(kind_of<T>().get != nullptr);
    return cell_of(kind_of<T>(), &value);
}

template <typename T>
[[nodiscard]] bool read_cell(std::string_view cell, T& value)
{
    static_assert(kind_of<T>().set != nullptr);
    return read_cell(kind_of<T>(), cell, &value);
}

// Functions that write tables of structs by their field tables.

/// Returns the header line `a,b,c`, without a line end.
[[nodiscard]] std::string csv_header(const FieldTable& fields);
/// Returns the cells of a struct, without a line end.
[[nodiscard]] std::string csv_line(const FieldTable& fields, const void* value);
[[nodiscard]] std::string csv_text(const FieldTable& fields, std::span<const void* const> values);
/// Returns the header line `a,b,c`, without a line end.
template <Described T>
[[nodiscard]] std::string csv_header()
{
    return csv_header(field_table<T>());
}

/// Returns the cells of a value, without a line end.
template <Described T>
[[nodiscard]] std::string csv_line(const T& value)
{
    return csv_line(field_table<T>(), &value);
}

/// Returns the header and all lines. Spare columns that have no value in any line are left out.
template <Described T>
[[nodiscard]] std::string csv_text(const std::vector<T>& values)
{
    std::vector<const void*> places;
    places.reserve(values.size());
    for (const T& value : values) places.push_back(&value);
    return csv_text(field_table<T>(), places);
}

} // namespace hapnet::base
