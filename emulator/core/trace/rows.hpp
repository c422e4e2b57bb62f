// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

inline constexpr std::size_t trace_rows_max = 1'000'000;
inline constexpr std::string_view too_many_values = "more than 1000000 values";

/// The lines of a text that say something: without the blanks around them, empty lines and those
/// that begin with '#'. A byte order mark is skipped.
class LineReader {
public:
    explicit LineReader(std::string_view text);

    /// nullopt at the end.
    [[nodiscard]] std::optional<std::string_view> next();

    /// An error at the line that next() gave last, or at the last one of the text.
    [[nodiscard]] tl::unexpected<base::Error> fail(std::string_view why) const;

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// For messages: at most 40 bytes, no control characters.
[[nodiscard]] std::string shortened(std::string_view text);

/// What the values of a trace are.
enum class Measure : std::uint8_t { delay, loss, rate };

/// Which column of a table has a measure, where its name does not say so.
struct Column {
    std::string what; // time, delay, loss, lost or rate
    std::string name; // in the header
    std::string unit; // empty: as the name ends
};
using Columns = std::vector<Column>;

/// "time=stamp:s, delay=rtt:ms": WHAT=NAME[:UNIT], separated by commas; empty: none.
[[nodiscard]] base::Result<Columns> parse_columns(std::string_view text);

/// What a file of measured values holds.
struct TraceRows {
    std::vector<double> values; // 1 to trace_rows_max; in ns, as shares, in bits a second
    /// Of each value: the datagram did not arrive, and the value is that of a neighbour.
    std::vector<bool> lost;
    /// Of each value, counted from the first, ascending; empty when there is no such column.
    std::vector<base::Duration> times;

    [[nodiscard]] std::vector<base::Duration> delays() const;
};

/// Reads CSV whose header names a column of the measure: delay_ns (_us, _ms, _s), loss (a share
/// from 0 to 1) or loss_percent, rate_bps (_kbps, _Mbps, _Gbps); and perhaps one of times: time_ns,
/// ..., time_s or t_ns, ..., t_s. `columns` may name others. Other columns are passed over.
/// A delay that is empty, "nan", "-", "*", "lost" or "timeout" is that of a lost datagram: it has
/// the delay of the one before; at the beginning, of the one after. Without a header, one delay
/// with its unit per line. Errors name the line.
[[nodiscard]] base::Result<TraceRows> read_trace_rows(std::string_view text, Measure measure,
                                                      const Columns& columns = {});

} // namespace hapnet::emulator
