// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/journal.hpp"
#include "proto/record/writer.hpp"

#include <exception>
#include <optional>
#include <system_error>

namespace hapnet::peer::monitor {

/// The values in the status line.
struct StatusLine {
    bool is_met = false; // the other peer has answered
    std::optional<record::TickRow> tick;
    std::optional<record::SessionRow> session;
    std::uint64_t messages = 0;
    std::uint64_t ticks_in_session = 0;
    std::uint64_t missed = 0;
};

/// Reads the journal of the servo thread: writes the record, prints events for a person, and draws
/// a status line on a terminal (elsewhere a plain line every 5 s).
class Monitor {
public:
    /// `writer` may be empty.
    Monitor(loop::Journal& journal, std::optional<record::Writer> writer, std::uint16_t peer_id);

    /// Reads everything in the journal. When the record cannot be written any more (a full disk),
    /// it says so once and goes on without it.
    void drain();
    /// Shows the status, if it is time to.
    void show(base::TimePoint now);
    /// After the servo has ended: reads the rest, closes the record, ends the line.
    void finish();
    /// Why the record is incomplete; null: it is complete.
    [[nodiscard]] std::exception_ptr record_failure() const { return record_failure_; }

private:
    void take(const record::Row& row);
    void give_up_record(const std::system_error& error);
    void tell(base::TimePoint at, std::string_view words);
    void say(std::string_view text);

    loop::Journal& journal_;
    std::optional<record::Writer> writer_;
    std::exception_ptr record_failure_;
    std::uint16_t peer_id_;
    bool is_terminal_;
    bool line_open_ = false;
    StatusLine status_;
    StatusLine shown_;
    std::optional<base::TimePoint> next_show_;
};

/// An event in words for a person.
[[nodiscard]] std::string_view describe(Event event);

} // namespace hapnet::peer::monitor
