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

// Tables of comma-separated values (RFC 4180): one header line, then as many cells a line. The
// columns of a struct are its fields (fields.hpp), whose keys name their units.

/// The lines of a table as they stand in a text.
struct CsvTable {
    struct Line {
        std::size_t number = 0; // number of the line in the text, from 1
        std::vector<std::string> cells;
    };

    std::string path;
    std::vector<std::string> columns;
    std::vector<Line> lines;
};

/// `path` names the text in errors, which begin with "PATH:LINE: ".
[[nodiscard]] Result<CsvTable> parse_csv(std::string_view text, const std::string& path);

/// A cell as it stands in a line: in quotes if it has to be.
[[nodiscard]] std::string csv_quoted(std::string_view cell);

/// A number with a fixed number of decimals, in a column. Elsewhere it is any number.
struct Decimals : Number {
    int decimals = 0;

    explicit constexpr Decimals(int count) : decimals{count} {}
};

/// The format of a column that stands in a table only where one of its lines has something in it.
/// Its member is an optional.
template <typename Format>
struct Spare : Format {
    static constexpr bool is_spare = true;
};

// The notation of values in cells: a number that is not finite, and an optional without a value, is
// empty.

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

// Tables of structs, by the tables of their fields.

/// `a,b,c`, without a line's end.
[[nodiscard]] std::string csv_header(const FieldTable& fields);
/// The cells of a struct, without a line's end.
[[nodiscard]] std::string csv_line(const FieldTable& fields, const void* value);
[[nodiscard]] std::string csv_text(const FieldTable& fields, std::span<const void* const> values);
/// `a,b,c`, without a line's end.
template <Described T>
[[nodiscard]] std::string csv_header()
{
    return csv_header(field_table<T>());
}

/// The cells of a value, without a line's end.
template <Described T>
[[nodiscard]] std::string csv_line(const T& value)
{
    return csv_line(field_table<T>(), &value);
}

/// Header and lines, without the spare columns that no value fills.
template <Described T>
[[nodiscard]] std::string csv_text(const std::vector<T>& values)
{
    std::vector<const void*> places;
    places.reserve(values.size());
    for (const T& value : values) places.push_back(&value);
    return csv_text(field_table<T>(), places);
}

} // namespace hapnet::base
