// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/journal.hpp"
#include "proto/record/writer.hpp"

#include <exception>
#include <optional>
#include <system_error>

namespace hapnet::peer {

/// What the status line is made of.
struct Glance {
    std::optional<record::TickRow> tick;
    std::optional<record::SessionRow> session;
    std::uint64_t messages = 0;
    std::uint64_t ticks_in_session = 0;
    std::uint64_t missed = 0;
};

/// Takes what the servo thread puts into the journal: writes the record, tells a person what
/// happens, and draws a status line on a terminal (elsewhere a plain line every 5 s).
class Watcher {
public:
    /// `writer` may be empty.
    Watcher(Journal& journal, std::optional<record::Writer> writer, std::uint16_t peer_id);

    /// Takes all that waits. When the record cannot be written any more (a full disk) it says so
    /// once, and goes on without.
    void drain();
    /// Shows where things stand, if it is time to.
    void show(base::TimePoint now);
    /// After the servo has ended: takes the rest, closes the record, ends the line.
    void finish();
    /// What kept the record from being written to its end; null: nothing.
    [[nodiscard]] std::exception_ptr record_failure() const { return record_failure_; }

private:
    void take(const record::Row& row);
    void give_up_record(const std::system_error& error);
    void tell(base::TimePoint at, std::string_view words);
    void say(std::string_view text);

    Journal& journal_;
    std::optional<record::Writer> writer_;
    std::exception_ptr record_failure_;
    std::uint16_t peer_id_;
    bool is_terminal_;
    bool line_open_ = false;
    Glance glance_;
    Glance shown_;
    std::optional<base::TimePoint> next_show_;
};

/// What to tell a person of an event.
[[nodiscard]] std::string_view words_for(Event event);

} // namespace hapnet::peer
