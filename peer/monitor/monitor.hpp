// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/control/frame_tap.hpp"
#include "peer/loop/journal.hpp"
#include "peer/monitor/event_log.hpp"
#include "peer/monitor/rate_limit.hpp"
#include "peer/monitor/recorder.hpp"
#include "proto/net/batch_sender.hpp"
#include "proto/net/terminal_line.hpp"
#include "proto/net/text_queue.hpp"

#include <cstdint>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::peer::monitor {

/// The values in the status line.
struct StatusLine {
    std::vector<std::uint16_t> awaited; // peers that have not answered yet; 0: any peer
    std::optional<record::TickRow> tick;
    std::optional<record::SessionRow> session;
    /// The round trip to each of the others: the shortest since the line before, or the last that
    /// was known.
    std::map<std::uint16_t, base::Duration> round_trips;
    std::uint64_t messages = 0;
    std::uint64_t ticks_in_session = 0;
    std::uint64_t missed = 0;
    net::SendOutcome sending = net::SendOutcome::sent; // outcome of the newest datagram
};

/// Names that appear in the texts for a person.
struct Named {
    std::uint16_t peer_id = 0;
    std::vector<std::uint16_t> others{0}; // the ids of the roster
    std::string body = "body";            // name of the first shared body
    bool has_several = false;             // several bodies are shared

    /// "the cube"; "the bodies" where there are several.
    [[nodiscard]] std::string shared() const { return has_several ? "the bodies" : "the " + body; }
};

/// Reads the journal of the servo thread: hands rows to the record and to clients that watch
/// frames, prints events for a person, and draws a status line on a terminal (elsewhere a plain
/// line every 5 s). It never waits: record and text are written by threads of their own.
class Monitor {
public:
    /// The most events that are told at once. Further ones are left out and counted: the network
    /// must not fill a log.
    static constexpr int events_at_once = 20;
    static constexpr base::Duration event_every{std::chrono::milliseconds{500}};

    /// Text goes to `screen`, and each event to `log`, too, unless that is null; both outlive it.
    Monitor(loop::Journal& journal, net::TextQueue& screen, Recorder::Setup recording, Named named,
            EventLog* log = nullptr);

    /// Reads everything in the journal. When the record cannot be written any more (a full disk),
    /// it says so once and goes on without it.
    void drain();
    /// Shows the status, if it is time to.
    void show(base::TimePoint now);
    /// Notes the outcome of the newest datagram that was sent.
    void on_sending(net::SendOutcome outcome) { status_.sending = outcome; }
    /// Something of which the journal does not know, for programs alone.
    void note(const LoggedEvent& event);
    /// After the servo has ended: reads the rest and closes the record, without waiting for that.
    void close();
    /// True once the record is on the disk, as far as it will ever be. Call it after close().
    [[nodiscard]] bool is_done() const { return !recorder_ || recorder_->is_done(); }
    /// After close(): tells of a record that has failed meanwhile, and ends the line.
    void finish();

    /// Begins a watch of frames of what is drained from now on.
    [[nodiscard]] control::FrameSource watch_frames() { return frames_.watch(); }

    /// See Recorder.
    [[nodiscard]] std::optional<base::Duration> held() const
    {
        return recorder_ ? recorder_->held() : std::nullopt;
    }
    [[nodiscard]] base::Result<std::string> keep(const std::string& name, base::TimePoint from);

    /// Returns the error that cut off the record; null: its file has taken all rows so far.
    [[nodiscard]] std::exception_ptr record_failure() const;
    /// True if the record has every row so far, or will have. After close() it is false until
    /// is_done().
    [[nodiscard]] bool is_record_whole() const;
    /// Rows that found no room on their way to the record.
    [[nodiscard]] std::uint64_t rows_lost() const;
    /// Rows that have reached the record: it grows as long as the disk takes them.
    [[nodiscard]] std::uint64_t rows_written() const
    {
        return recorder_ ? recorder_->written() : 0;
    }

private:
    void take(const record::Row& row);
    void note_round_trip(const loop::HeardMessage& heard);
    void look_at_record();
    [[nodiscard]] bool is_pair() const { return named_.others.size() <= 1; }
    void on_event(const loop::TimedEvent& event);
    void tell(const LoggedEvent& event);
    [[nodiscard]] std::optional<base::TimePoint> start() const;
    void say(std::string_view text);

    loop::Journal& journal_;
    net::TextQueue& screen_;
    EventLog* log_;
    std::optional<Recorder> recorder_;
    FrameTap frames_;
    bool is_failure_told_ = false;
    bool is_closed_ = false;
    RateLimit events_{events_at_once, event_every};
    std::uint64_t events_left_out_ = 0;
    Named named_;
    net::TerminalLine line_;
    std::map<std::uint16_t, base::Duration> round_trips_; // shortest since the last line
    StatusLine status_;
    StatusLine shown_;
    std::optional<base::TimePoint> next_show_;
};

/// Why nothing leaves, in words for a person; "" when it does, or soon will.
[[nodiscard]] std::string_view describe(net::SendOutcome outcome);

/// Describes news of the line to the other peer of two, with what to do about it.
[[nodiscard]] std::string_view describe(line::News news);

/// Describes an event in a session of two for a person. `shared`: "the cube".
[[nodiscard]] std::string describe(Event event, std::string_view shared);

/// Describes an event in a session of more than two, and names the peer that it is about.
[[nodiscard]] std::string describe_in_circle(line::News news, std::uint16_t about);
[[nodiscard]] std::string describe_in_circle(Event event, std::string_view shared,
                                             std::uint16_t about);

} // namespace hapnet::peer::monitor
