// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/journal.hpp"
#include "proto/net/text_queue.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer::monitor {

/// An event, for programs and, if it has `words`, for a person.
struct LoggedEvent {
    base::TimePoint at;
    std::string_view name;            // docs/formats/events.md lists all names
    std::uint16_t about = 0;          // id of the peer that it is about; 0: all, or not known
    std::string words{};              // text for a person; "": no text is shown
    nlohmann::ordered_json details{}; // further keys; null: none
};

/// Returns the event's name in logs.
[[nodiscard]] std::string_view name_of(Event event);
/// Returns the event for news about a device, without `words`.
[[nodiscard]] LoggedEvent event_of(const loop::TimedDeviceNews& timed);

/// Returns the line of an event. `start` is that of the session, if known.
[[nodiscard]] std::string line_of(const LoggedEvent& event, std::optional<base::TimePoint> start);

/// The output of --events: a line of JSON for each event, written by a separate thread. No thread
/// waits for the reader. Lines that do not fit are dropped and counted.
class EventLog {
public:
    /// `place` is a file, which is emptied, a FIFO, which may have no reader yet, or "-" for `out`,
    /// which must outlive this. Throws std::system_error naming the file.
    EventLog(const std::string& place, net::TextQueue& out);

    void put(const LoggedEvent& event, std::optional<base::TimePoint> start)
    {
        queue_.put(line_of(event, start));
    }

    [[nodiscard]] const net::TextQueue& queue() const { return queue_; }
    /// True if no line has been lost so far.
    [[nodiscard]] bool is_whole() const { return queue_.error() == 0 && queue_.lost() == 0; }

private:
    std::optional<net::TextQueue> own_; // nullopt: events go to stdout
    net::TextQueue& queue_;
};

} // namespace hapnet::peer::monitor
