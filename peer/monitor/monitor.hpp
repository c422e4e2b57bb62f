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

/// The values that the status line shows.
struct StatusLine {
    std::vector<std::uint16_t> awaited; // peers that have not answered yet; 0: any peer
    std::optional<record::TickRow> tick;
    std::optional<record::SessionRow> session;
    /// The round trip to each of the others: the shortest since the previous line, or the last
    /// known one.
    std::map<std::uint16_t, base::Duration> round_trips;
    std::uint64_t messages = 0;
    std::uint64_t ticks_in_session = 0;
    std::uint64_t missed = 0;
    net::SendOutcome sending = net::SendOutcome::sent; // outcome of the newest datagram
};

/// Names for the texts for people.
struct Named {
    std::uint16_t peer_id = 0;
    std::vector<std::uint16_t> others{0}; // the ids of the roster
    std::string body = "body";            // name of the first shared body
    bool has_several = false;             // several bodies are shared

    /// Returns "the cube", or "the bodies" if there are several.
    [[nodiscard]] std::string shared() const { return has_several ? "the bodies" : "the " + body; }
};

/// Reads the journal of the servo thread. Passes rows to the record and to clients that watch
/// frames, prints events for people, and shows a status line on a terminal (elsewhere a plain line
/// every 5 s). It never waits, because separate threads write record and text.
class Monitor {
public:
    /// The largest number of events that are shown at once. Others are left out and counted,
    /// because the network must not be able to fill a log.
    static constexpr int events_at_once = 20;
    static constexpr base::Duration event_every{std::chrono::milliseconds{500}};

    /// Writes text to `screen`, and each event also to `log`, unless that is nullptr. Both must
    /// outlive it.
    Monitor(loop::Journal& journal, net::TextQueue& screen, Recorder::Setup recording, Named named,
            EventLog* log = nullptr);

    /// Reads everything in the journal. If the record cannot be written any more (a full disk), it
    /// says so once and continues without it.
    void drain();
    /// Shows the status if it is due.
    void show(base::TimePoint now);
    /// Notes the outcome of the newest datagram that was sent.
    void on_sending(net::SendOutcome outcome) { status_.sending = outcome; }
    /// Notes an event that is not in the journal, for programs only.
    void note(const LoggedEvent& event);
    /// Reads the rest of the journal and closes the record, without waiting for it. Call it after
    /// the servo has ended.
    void close();
    /// True once the record is complete on the disk, or has been given up. Call it after close().
    [[nodiscard]] bool is_done() const { return !recorder_ || recorder_->is_done(); }
    /// Reports a record that has failed since close(), and ends the status line. Call it after
    /// close().
    void finish();

    /// Begins a watch of frames of the rows that are drained from now on.
    [[nodiscard]] control::FrameSource watch_frames() { return frames_.watch(); }

    /// Returns the same as Recorder::held().
    [[nodiscard]] std::optional<base::Duration> held() const
    {
        return recorder_ ? recorder_->held() : std::nullopt;
    }
    [[nodiscard]] base::Result<std::string> keep(const std::string& name, base::TimePoint from);

    /// Returns the error that cut off the record; null: its file has taken all rows so far.
    [[nodiscard]] std::exception_ptr record_failure() const;
    /// True if the record has all rows so far, or will have them. After close() it is false until
    /// is_done().
    [[nodiscard]] bool is_record_whole() const;
    /// True if no event has been lost so far.
    [[nodiscard]] bool are_events_whole() const { return log_ == nullptr || log_->is_whole(); }
    /// Returns the number of rows that were dropped on their way to the record.
    [[nodiscard]] std::uint64_t rows_lost() const;
    /// Returns the number of rows that have been written to the record. It grows as long as the
    /// disk accepts them.
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

/// Returns why nothing can be sent, as text for people; "" if messages are sent, or will be soon.
[[nodiscard]] std::string_view describe(net::SendOutcome outcome);

/// Describes news of the line to the only other peer, with what to do about it.
[[nodiscard]] std::string_view describe(line::News news);

/// Describes an event in a session of two for a person. `shared`: "the cube".
[[nodiscard]] std::string describe(Event event, std::string_view shared);

/// Describes news in a session of more than two, and names the peer that it is about.
[[nodiscard]] std::string describe_in_circle(line::News news, std::uint16_t about);
[[nodiscard]] std::string describe_in_circle(Event event, std::string_view shared,
                                             std::uint16_t about);

} // namespace hapnet::peer::monitor
