// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

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

/// What a file of delays holds.
struct DelayRows {
    std::vector<base::Duration> delays; // 1 to QuantileTable::values_max, not negative
    std::vector<base::Duration> times;  // of each, ascending; empty when there is no such column
};

/// Reads one delay with its unit per line, or CSV whose header names a column delay_ns, delay_us,
/// delay_ms or delay_s and perhaps another time_ns, ..., time_s, which must begin at 0 and ascend.
/// Other columns are passed over. Errors name the line.
[[nodiscard]] base::Result<DelayRows> read_delay_rows(std::string_view text);

} // namespace hapnet::emulator
