// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/lines.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::base {

// Finds columns in tables of measured values that any program may have written. Commas, semicolons,
// tabs or blanks separate the cells, a header may be missing, and numbers may have decimal commas.

/// A user's statement that a column of a table holds values of one kind, for tables whose own
/// column names do not show it.
struct Column {
    std::string what; // the name of a ColumnKind
    std::string name; // name in the header; without a header the column's number, from 1
    std::string unit; // empty: the unit at the end of the name
};
using Columns = std::vector<Column>;

/// Parses "time=stamp:s, delay=rtt:ms": entries WHAT=NAME[:UNIT], separated by commas. An empty
/// text means no entries. `known` lists the allowed words for WHAT.
[[nodiscard]] Result<Columns> parse_columns(std::string_view text,
                                            std::span<const std::string_view> known);

/// A number as tables contain it: with a decimal point or a decimal comma, or in scientific
/// notation. number_in() returns nullopt for other cells, and for a number with several marks.
struct WrittenNumber {
    double value = 0.0;
    char mark = '\0'; // '.' or ','; '\0': no mark
};
[[nodiscard]] std::optional<WrittenNumber> number_in(std::string_view cell);

/// True if a cell means "no value": it is empty, "nan", "-", "*", "lost" or "timeout".
[[nodiscard]] bool says_lost(std::string_view cell);

/// A unit that the numbers of a column may have, and its size.
struct ColumnUnit {
    std::string_view name;
    double factor;
};

/// A quantity that a column may hold. The column is called "<what>_<unit>".
struct ColumnKind {
    std::string_view what;
    std::span<const ColumnUnit> units{};
    /// The value of the number 1 in a column that is called "<what>" alone. nullopt: the name must
    /// contain a unit.
    std::optional<double> bare_factor{};
    double most = 0.0; // largest value, after the conversion by its unit
    std::string_view most_text{};
    std::string_view short_name{}; // "t": its column may also be called "t_<unit>"
    bool is_optional = false;
    bool may_stand_alone = false; // a single unnamed column is left to other readers
    // Used in messages.
    std::string_view usual_names{};  // "delay_ns, delay_us, delay_ms or delay_s"
    std::string_view example_unit{}; // ":ms"
};

/// A column of numbers, which are written without their unit.
struct NumberColumn {
    std::string name; // name of the column in messages
    std::size_t place = 0;
    double factor = 1.0;
    double most = 0.0;
    std::string_view most_text{};
};

/// Reads the numbers of one table. All of them have the same decimal mark.
class NumberReader {
public:
    /// Returns the number in a cell, before the factor of the column is applied. The error names
    /// the column.
    [[nodiscard]] Result<double> read(std::string_view cell, const NumberColumn& column);

private:
    char mark_ = '\0'; // decimal mark of the numbers so far; '\0': none yet
};

/// The layout of a table, with the columns that hold the wanted values.
struct TableLayout {
    char separator = ',';
    std::size_t cells = 1;
    /// The columns of the kinds that were asked for, in the same order. If no element has a value,
    /// the table is a single unnamed column of a kind that may stand alone.
    std::vector<std::optional<NumberColumn>> columns{};
    bool has_header = false; // the first line has no values
};

/// Returns an error text for a line whose number of cells does not fit the table.
[[nodiscard]] std::string refusal_of_cells(std::size_t cells, const TableLayout& layout);

/// Finds the layout of the table that begins with the next line. The first of `kinds` must be
/// present. The error says which column is missing and how to name it.
[[nodiscard]] Result<TableLayout>
find_layout(const LineReader& lines, std::span<const ColumnKind> kinds, const Columns& columns);

} // namespace hapnet::base
