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

// Rows of a record as lines of CSV, without the end of line. The first column is the time in
// seconds since `zero`. Numbers that are not finite become empty cells.

/// Returns the zero of the time in a CSV: T0 of the last session, or the first tick if there is no
/// session.
[[nodiscard]] base::TimePoint csv_zero(const record::Record& record);

[[nodiscard]] std::string tick_csv_header();
[[nodiscard]] std::string csv_line(const record::TickRow& row, base::TimePoint zero);

/// The columns of the shared bodies: one line for each body after each tick. A record without rows
/// of bodies has the one body that its ticks hold.
[[nodiscard]] std::string body_csv_header();
void for_each_body_csv_line(const record::Record& record, base::TimePoint zero,
                            const std::function<void(const std::string&)>& take);

/// The newest session row with each of the other peers, by the peer's id. In older records the id
/// is 0.
using NewestSessions = std::map<std::uint16_t, record::SessionRow>;
[[nodiscard]] NewestSessions newest_sessions(const record::Record& record);

/// The columns of messages. `sent_s` is the time of the sender's own clock, as the message holds
/// it. `sent_time_s` is the same moment since `zero`, by the newest session with that peer; it is
/// empty without one.
[[nodiscard]] std::string message_csv_header();
[[nodiscard]] std::string csv_line(const record::MessageRow& row, base::TimePoint zero,
                                   const NewestSessions& sessions);

/// The columns of both peers of a session on one time axis: an as-of join. There is one line for
/// each tick of A, with the last tick of B that is not later and B's own time. The cells of B are
/// empty before its first tick. `time_s` and `b_time_s` both count from T0 on A's clock.
[[nodiscard]] std::string joined_csv_header();
void for_each_joined_csv_line(const Session& session,
                              const std::function<void(const std::string&)>& take);

} // namespace hapnet::lab::records
