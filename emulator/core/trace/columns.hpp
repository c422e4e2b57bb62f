// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/columns.hpp"
#include "proto/base/lines.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace hapnet::emulator {

/// The meaning of the values of a table.
enum class Measure : std::uint8_t { delay, loss, rate, lost };
[[nodiscard]] std::string_view name_of(Measure measure);

/// Parses "time=stamp:s, delay=rtt:ms"; see base::parse_columns(). A column may hold time, delay,
/// loss, lost or rate.
[[nodiscard]] base::Result<base::Columns> parse_columns(std::string_view text);

/// Returns the layout of the table that begins with the next line: the column of the measure and
/// that of the times, if there is one. A table with one delay and its unit on each line has
/// neither. The error says what is missing and how to name it.
[[nodiscard]] base::Result<base::TableLayout>
find_layout(const base::LineReader& lines, Measure measure, const base::Columns& columns);

/// Returns the column of the values, or of the times, in such a layout.
[[nodiscard]] inline const std::optional<base::NumberColumn>&
value_of(const base::TableLayout& layout)
{
    return layout.columns[0];
}
[[nodiscard]] inline const std::optional<base::NumberColumn>&
time_column(const base::TableLayout& layout)
{
    return layout.columns[1];
}

} // namespace hapnet::emulator
