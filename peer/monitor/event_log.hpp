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

/// Something that happened, for programs and, with words, for a person.
struct LoggedEvent {
    base::TimePoint at;
    std::string_view name;            // docs/formats/events.md lists all names
    std::uint16_t about = 0;          // id of the peer that it is about; 0: all, or not known
    std::string words{};              // text for a person; "": no text is shown
    nlohmann::ordered_json details{}; // further keys; null: none
};

/// Returns the event's name in logs.
[[nodiscard]] std::string_view name_of(Event event);
/// Returns the event of a device's news. Its `words` are still empty.
[[nodiscard]] LoggedEvent event_of(const loop::TimedDeviceNews& timed);

/// The line of an event. `start`: of the session, as far as it is known.
[[nodiscard]] std::string line_of(const LoggedEvent& event, std::optional<base::TimePoint> start);

/// The output of --events: a line of JSON for each event, written by a thread of its own. No thread
/// waits for the reader. Lines that find no room are dropped and counted.
class EventLog {
public:
    /// A file, which is emptied, a FIFO, which need not have a reader yet, or "-": `out`, which
    /// outlives this. Throws std::system_error naming the file.
    EventLog(const std::string& place, net::TextQueue& out);

    void put(const LoggedEvent& event, std::optional<base::TimePoint> start)
    {
        queue_.put(line_of(event, start));
    }

    [[nodiscard]] const net::TextQueue& queue() const { return queue_; }

private:
    std::optional<net::TextQueue> own_; // nullopt: events go to stdout
    net::TextQueue& queue_;
};

} // namespace hapnet::peer::monitor
