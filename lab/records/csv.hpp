// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <functional>
#include <optional>
#include <string>

namespace hapnet::lab::records {

// Rows of a record as lines of CSV, without their end of line. The first column is the time in
// seconds since `zero`; numbers that are not finite become empty cells.

/// Where the time of a CSV starts: T0 of the last session; without one, the first tick.
[[nodiscard]] base::TimePoint csv_zero(const record::Record& record);

[[nodiscard]] std::string tick_csv_header();
[[nodiscard]] std::string csv_line(const record::TickRow& row, base::TimePoint zero);

/// The same moment on the remote's clock; without a session nullopt.
[[nodiscard]] std::optional<base::TimePoint> remote_csv_zero(const record::Record& record);

/// `sent_s` is the sender's own clock, as it stands in the message; `sent_time_s` counts from
/// `remote_zero`, and is empty without one.
[[nodiscard]] std::string message_csv_header();
[[nodiscard]] std::string csv_line(const record::MessageRow& row, base::TimePoint zero,
                                   std::optional<base::TimePoint> remote_zero);

/// Both peers of a session on one time axis: an as-of join. One line for each tick of A, with the
/// last tick of B that is not later, and its own time; cells of B are empty before its first.
/// `time_s` and `b_time_s` both count from T0 on A's clock.
[[nodiscard]] std::string joined_csv_header();
void for_each_joined_csv_line(const Session& session,
                              const std::function<void(const std::string&)>& take);

} // namespace hapnet::lab::records
