// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::base {

// Tables of comma-separated values (RFC 4180): one header line, then as many cells a line. The
// columns of a struct are its fields (fields.hpp), whose keys name their units.

/// The lines of a table as they stand in a text.
struct CsvTable {
    struct Line {
        std::size_t number = 0; // in the text, from 1
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
    int count = 0;

    explicit constexpr Decimals(int decimals) : count{decimals} {}
    [[nodiscard]] std::string cell(double value) const
    {
        return std::isfinite(value) ? fmt::format("{:.{}f}", value, count) : "";
    }
};

/// The format of a column that stands in a table only where one of its lines has something in it.
/// Its member is an optional.
template <typename Format>
struct Spare : Format {
    static constexpr bool is_spare = true;
};

// How a value stands in a cell: a number that is not finite, and an optional without a value, is
// empty. For types of one's own, beside them: overloads of cell_of(value) and read_cell(cell,
// value).

[[nodiscard]] inline std::string cell_of(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}
[[nodiscard]] inline std::string cell_of(const std::string& value) { return csv_quoted(value); }
[[nodiscard]] inline std::string cell_of(bool value) { return value ? "true" : "false"; }

template <std::integral T>
[[nodiscard]] std::string cell_of(T value)
{
    return fmt::format("{}", value);
}
template <Named Enum>
[[nodiscard]] std::string cell_of(Enum value)
{
    return std::string{name_of(value)};
}

/// What a cell has to be when it is not: "a number".
template <typename T>
[[nodiscard]] std::string expected_in_cell()
{
    if constexpr (Named<T>) {
        return fmt::format("one of {}", fmt::join(names_of_enum<T>, ", "));
    } else if constexpr (std::is_same_v<T, bool>) {
        return "true or false";
    } else if constexpr (std::is_arithmetic_v<T>) {
        return "a number";
    } else {
        return "a text";
    }
}

/// False when the cell is something else.
template <typename T>
requires std::is_arithmetic_v<T>
bool read_cell(std::string_view cell, T& value)
{
    if constexpr (std::is_same_v<T, bool>) {
        value = cell == "true";
        return value || cell == "false";
    } else {
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc{} || end != cell.data() + cell.size()) return false;
        if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
        return true;
    }
}
inline bool read_cell(std::string_view cell, std::string& value)
{
    value = cell;
    return true;
}
template <Named Enum>
bool read_cell(std::string_view cell, Enum& value)
{
    const auto found = named<Enum>(cell);
    if (found) value = *found;
    return found.has_value();
}

namespace detail {

template <typename Format, typename Value>
[[nodiscard]] std::string cell_text(const Format& format, const Value& value)
{
    if constexpr (is_optional<Value>) {
        return value ? cell_text(format, *value) : "";
    } else if constexpr (requires { format.cell(value); }) {
        return format.cell(value);
    } else {
        return cell_of(value);
    }
}

template <typename Value>
bool read_cell_into(std::string_view cell, Value& value)
{
    if constexpr (is_optional<Value>) {
        value.reset();
        return cell.empty() || read_cell(cell, value.emplace());
    } else {
        return read_cell(cell, value);
    }
}

} // namespace detail

namespace detail {

template <typename Format>
concept IsSpare = requires
{
    requires Format::is_spare;
};

/// Which of the columns a table of these values has.
template <Described T>
[[nodiscard]] std::vector<bool> columns_for(const std::vector<T>& values)
{
    std::vector<bool> shown;
    const auto look = [&](const T& value, bool is_first) {
        std::size_t column = 0;
        for_each_field(
            [&]<typename Member>(const auto& field, const Member& member) {
                using Format = std::remove_cvref_t<decltype(field.format)>;
                if (is_first) shown.push_back(!IsSpare<Format>);
                if constexpr (is_optional<Member>) {
                    if (member) shown[column] = true;
                }
                ++column;
            },
            value);
    };
    look(T{}, true);
    for (const T& value : values) look(value, false);
    return shown;
}

/// The texts of the columns that are shown, with commas; text(field, member) gives each.
template <Described T, typename TextOf>
[[nodiscard]] std::string csv_cells(const T& value, const std::vector<bool>& shown,
                                    const TextOf& text)
{
    std::string line;
    bool is_first = true;
    std::size_t column = 0;
    for_each_field(
        [&](const auto& field, const auto& member) {
            if (!shown[column++]) return;
            if (!is_first) line += ',';
            is_first = false;
            line += text(field, member);
        },
        value);
    return line;
}

} // namespace detail

/// `a,b,c`, without a line's end.
template <Described T>
[[nodiscard]] std::string csv_header()
{
    std::string line;
    for_each_field([&](const auto& field,
                       const auto&) { line += (line.empty() ? "" : ",") + std::string{field.key}; },
                   T{});
    return line;
}

/// The cells of a value, without a line's end.
template <Described T>
[[nodiscard]] std::string csv_line(const T& value)
{
    std::string line;
    bool is_first = true;
    for_each_field(
        [&](const auto& field, const auto& member) {
            if (!is_first) line += ',';
            is_first = false;
            line += detail::cell_text(field.format, member);
        },
        value);
    return line;
}

/// Header and lines, without the spare columns that no value fills.
template <Described T>
[[nodiscard]] std::string csv_text(const std::vector<T>& values)
{
    const std::vector<bool> shown = detail::columns_for(values);
    const auto key = [](const auto& field, const auto&) { return std::string{field.key}; };
    const auto cell = [](const auto& field, const auto& member) {
        return detail::cell_text(field.format, member);
    };
    std::string text = detail::csv_cells(T{}, shown, key) + '\n';
    for (const T& value : values) text += detail::csv_cells(value, shown, cell) + '\n';
    return text;
}

/// The values of a table, found by the names of its columns: others are passed over.
template <Described T>
[[nodiscard]] Result<std::vector<T>> read_csv(std::string_view text, const std::string& path)
{
    const auto table = parse_csv(text, path);
    if (!table) return tl::unexpected{table.error()};
    std::vector<T> values;
    std::optional<std::string> complaint;
    const auto complain = [&](std::size_t line, const std::string& what) {
        if (!complaint) complaint = fmt::format("{}:{}: {}", path, line, what);
    };
    const auto read = [&](const CsvTable::Line& line, T& value) {
        for_each_field(
            [&](const auto& field, auto& member) {
                using Member = std::remove_cvref_t<decltype(member)>;
                const auto& columns = table->columns;
                const auto column = std::find(columns.begin(), columns.end(), field.key);
                using Format = std::remove_cvref_t<decltype(field.format)>;
                if (column == columns.end()) {
                    if (detail::IsSpare<Format>) return;
                    return complain(1, fmt::format("expected a column '{}'", field.key));
                }
                const auto& cell = line.cells[static_cast<std::size_t>(column - columns.begin())];
                if (detail::read_cell_into(cell, member)) return;
                using Plain = typename detail::WithoutOptional<Member>::type;
                complain(line.number, fmt::format("{}: expected {}, found '{}'", field.key,
                                                  expected_in_cell<Plain>(), cell));
            },
            value);
    };
    for (const CsvTable::Line& line : table->lines) read(line, values.emplace_back());
    if (complaint) return fail(*complaint);
    return values;
}

} // namespace hapnet::base
