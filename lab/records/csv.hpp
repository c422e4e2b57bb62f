// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <string>

namespace hapnet::lab::records {

// Rows of a record as lines of CSV, without their end of line. The first column is the time in
// seconds since `zero`; numbers that are not finite become empty cells.

/// Where the time of a CSV starts: T0 of the last session; without one, the first tick.
[[nodiscard]] base::TimePoint csv_zero(const record::Record& record);

[[nodiscard]] std::string tick_csv_header();
[[nodiscard]] std::string csv_line(const record::TickRow& row, base::TimePoint zero);

/// `sent_s` is the sender's own clock, as it stands in the message.
[[nodiscard]] std::string message_csv_header();
[[nodiscard]] std::string csv_line(const record::MessageRow& row, base::TimePoint zero);

} // namespace hapnet::lab::records
