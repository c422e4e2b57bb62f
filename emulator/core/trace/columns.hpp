// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/trace/lines.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// The meaning of the values of a table.
enum class Measure : std::uint8_t { delay, loss, rate, lost };
[[nodiscard]] std::string_view name_of(Measure measure);

/// Which column of a table has a measure, where its name does not say so.
struct Column {
    std::string what; // time, delay, loss, lost or rate
    std::string name; // in the header; of a table without one, the column's number, from 1
    std::string unit; // empty: as the name ends
};
using Columns = std::vector<Column>;

/// "time=stamp:s, delay=rtt:ms": WHAT=NAME[:UNIT], separated by commas; empty: none.
[[nodiscard]] base::Result<Columns> parse_columns(std::string_view text);

/// A number as tables write it: with a decimal point or a decimal comma, and as computers do.
/// nullopt: the cell is no such number, or one of several marks.
struct WrittenNumber {
    double value = 0.0;
    char mark = '\0'; // '.' or ','; 0: it has none
};
[[nodiscard]] std::optional<WrittenNumber> number_in(std::string_view cell);

/// Whether a cell of delays says that the datagram was lost: empty, "nan", "-", "lost", ...
[[nodiscard]] bool says_lost(std::string_view cell);

/// A column of numbers that are written without their unit.
struct NumberColumn {
    std::string name; // for messages
    std::size_t place = 0;
    double factor = 1.0;
    double most = 0.0;
    std::string_view most_text{};
};

/// Where a table has what is looked for.
struct TableLayout {
    char separator = ',';
    std::size_t cells = 1;
    std::optional<NumberColumn> value{}; // nullopt: one delay with its unit per line
    std::optional<NumberColumn> time{};
    bool has_header = false; // the first line has no values
};

/// The layout of the table that begins with the next line. The error says what is missing and how
/// to name it.
[[nodiscard]] base::Result<TableLayout> find_layout(const LineReader& lines, Measure measure,
                                                    const Columns& columns);

} // namespace hapnet::emulator
