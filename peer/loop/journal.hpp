// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/peer.hpp"
#include "peer/line/datagram.hpp"
#include "peer/line/news.hpp"
#include "peer/monitor/device_news.hpp"
#include "proto/record/rows.hpp"

#include <atomic>
#include <readerwriterqueue/readerwritercircularbuffer.h>
#include <variant>

namespace hapnet::peer::loop {

/// An event that a person should be told of, and when it happened.
struct TimedEvent {
    Event event = Event::met;
    base::TimePoint at;
    std::uint16_t about = 0; // id of the peer that it is about; 0: all, or not known
};

/// News of the device for a person, and its time.
struct TimedDeviceNews {
    monitor::DeviceNews news;
    base::TimePoint at;
};

/// News of the line to another peer for a person, and its time.
struct TimedLineNews {
    line::News news = line::News::sealed;
    base::TimePoint at;
    std::uint16_t about = 0;
};

/// A message from another peer, which becomes a record::MessageRow. Never allocates.
struct HeardMessage {
    std::uint64_t tick = 0;
    base::TimePoint received_at;
    std::uint16_t from = 0;
    line::Datagram message;

    [[nodiscard]] record::MessageRow row() const
    {
        const auto bytes = message.bytes();
        return {tick, received_at, from, {bytes.begin(), bytes.end()}};
    }
};

/// An entry of the servo thread for the record, the status line and the log. A row is of a tick, a
/// body or a session.
using Entry = std::variant<record::Row, HeardMessage, TimedEvent, TimedDeviceNews, TimedLineNews>;

/// The one way out of the servo thread: a bounded queue that never makes that thread wait. Entries
/// that do not fit are dropped and counted.
class Journal {
public:
    /// Servo side.
    void put(const Entry& entry)
    {
        if (!entries_.try_enqueue(entry)) lost_.fetch_add(1, std::memory_order_relaxed);
    }

    /// Reader side; nullopt when the journal is empty.
    [[nodiscard]] std::optional<Entry> take()
    {
        Entry entry;
        if (!entries_.try_dequeue(entry)) return std::nullopt;
        return entry;
    }

    [[nodiscard]] std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

private:
    // 8 s of ticks and messages of two peers with one body, 2 s of eight, 1 s of eight with eight
    // bodies: the recorder has as many.
    static constexpr std::size_t capacity = 16384;

    // The package has two queues. ThreadSanitizer can follow this one: it synchronises by atomics
    // alone, without free-standing fences.
    moodycamel::BlockingReaderWriterCircularBuffer<Entry> entries_{capacity};
    std::atomic<std::uint64_t> lost_{0};
};

} // namespace hapnet::peer::loop
