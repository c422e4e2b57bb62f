// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace hapnet::lab::records {

// Rows of a record as lines of CSV, without their end of line. The first column is the time in
// seconds since `zero`; numbers that are not finite become empty cells.

/// The zero of the time in a CSV: T0 of the last session; without one, the first tick.
[[nodiscard]] base::TimePoint csv_zero(const record::Record& record);

[[nodiscard]] std::string tick_csv_header();
[[nodiscard]] std::string csv_line(const record::TickRow& row, base::TimePoint zero);

/// The shared bodies after each tick, a line for each. A record without rows of bodies gives the
/// one body that its ticks hold.
[[nodiscard]] std::string body_csv_header();
void for_each_body_csv_line(const record::Record& record, base::TimePoint zero,
                            const std::function<void(const std::string&)>& take);

/// The newest row of the session with each of the others, by its id; 0 in older records.
using NewestSessions = std::map<std::uint16_t, record::SessionRow>;
[[nodiscard]] NewestSessions newest_sessions(const record::Record& record);

/// `sent_s` is the sender's own clock, as it stands in the message; `sent_time_s` the same moment
/// since `zero`, by the newest session with that peer, and empty without one.
[[nodiscard]] std::string message_csv_header();
[[nodiscard]] std::string csv_line(const record::MessageRow& row, base::TimePoint zero,
                                   const NewestSessions& sessions);

/// Both peers of a session on one time axis: an as-of join. One line for each tick of A, with the
/// last tick of B that is not later, and its own time; cells of B are empty before its first.
/// `time_s` and `b_time_s` both count from T0 on A's clock.
[[nodiscard]] std::string joined_csv_header();
void for_each_joined_csv_line(const Session& session,
                              const std::function<void(const std::string&)>& take);

} // namespace hapnet::lab::records
