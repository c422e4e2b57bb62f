// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/trace/columns.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

inline constexpr std::size_t trace_rows_max = 10'000'000;
inline constexpr std::string_view too_many_values = "more than 10000000 values: cut the file";

/// The error for a table whose values need times.
inline constexpr std::string_view without_times =
    "line 1: no column is named time_ns, time_us, time_ms or time_s: name it, such as "
    "columns \"time=stamp:s\", or say how long each value lasts, such as slot = \"10ms\"";

/// The contents of a file of measured values.
struct TraceRows {
    std::vector<double> values; // 1 to trace_rows_max; in ns, as shares, in bits a second, 0 or 1
    /// True for a value whose datagram did not arrive. The value is then that of a neighbour.
    std::vector<bool> lost;
    /// The time of each value, counted from the first, ascending; empty when there are none.
    std::vector<base::Duration> times;

    [[nodiscard]] std::vector<base::Duration> delays() const;
};

/// The names and the timing of a file's columns, where the file does not state them.
struct TableFormat {
    base::Columns columns{};
    base::Duration slot{}; // each value is a slot of this length later than the one before; 0: none
};

/// Returns the format that `columns` (see parse_columns) and a slot describe. The error begins with
/// the key.
[[nodiscard]] base::Result<TableFormat> parse_format(std::string_view columns,
                                                     base::Duration slot = {});

/// Reads a table whose header names a column of the measure: delay_ns (_us, _ms, _s), loss (a share
/// from 0 to 1) or loss_percent, rate_bps (_kbps, _Mbps, _Gbps), or lost (0 or 1). It may also name
/// a column of times: time_ns, ..., time_s or t_ns, ..., t_s. Commas, semicolons, tabs or blanks
/// separate the cells, which may be in quotes. Numbers have a decimal point, or a decimal comma
/// where commas do not separate cells; all numbers use one of the two. The columns of the format
/// may have other names, and in a table without a header they are numbers. Other columns are
/// ignored. A delay that is empty, "nan", "-", "*", "lost" or "timeout" belongs to a lost datagram.
/// Its value is the delay of the previous datagram, or at the beginning that of the next one. In a
/// table of one column an empty line between two others is such a delay. Without a header, there is
/// one delay with its unit per line; with a slot, a number there is in milliseconds. Memory: at
/// most 17 B a row. Errors name the line.
[[nodiscard]] base::Result<TraceRows> read_trace_rows(std::string_view text, Measure measure,
                                                      const TableFormat& format = {});

} // namespace hapnet::emulator
