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

/// "time=stamp:s, delay=rtt:ms": see base::parse_columns(). A column may hold time, delay, loss,
/// lost or rate.
[[nodiscard]] base::Result<base::Columns> parse_columns(std::string_view text);

/// The layout of the table that begins with the next line: of the measure and of times, if there
/// are any. Neither has a column where each line is one delay with its unit. The error says what is
/// missing and how to name it.
[[nodiscard]] base::Result<base::TableLayout>
find_layout(const base::LineReader& lines, Measure measure, const base::Columns& columns);

/// The columns of the values and of the times in such a layout.
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
