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

/// An event to report to a person, with its time.
struct TimedEvent {
    Event event = Event::met;
    base::TimePoint at;
    std::uint16_t about = 0; // id of the peer that it is about; 0: all, or not known
};

/// News about the device for a person, with its time.
struct TimedDeviceNews {
    monitor::DeviceNews news;
    base::TimePoint at;
};

/// News about the line to another peer for a person, with its time.
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

/// An entry that the servo thread writes for the record, the status line and the log. A row belongs
/// to a tick, a body or a session.
using Entry = std::variant<record::Row, HeardMessage, TimedEvent, TimedDeviceNews, TimedLineNews>;

/// The only output of the servo thread: a bounded queue that never blocks that thread. Entries that
/// do not fit are dropped and counted.
class Journal {
public:
    /// Adds an entry. For the servo thread.
    void put(const Entry& entry)
    {
        if (!entries_.try_enqueue(entry)) lost_.fetch_add(1, std::memory_order_relaxed);
    }

    /// Takes the oldest entry; nullopt if the journal is empty. For the reading thread.
    [[nodiscard]] std::optional<Entry> take()
    {
        Entry entry;
        if (!entries_.try_dequeue(entry)) return std::nullopt;
        return entry;
    }

    [[nodiscard]] std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

private:
    // The capacity. It is enough for 8 s of ticks and messages of two peers with one body, 2 s of
    // eight peers, or 1 s of eight peers with eight bodies. The recorder has the same capacity.
    static constexpr std::size_t capacity = 16384;

    // The package has two queues. ThreadSanitizer supports this one, because it synchronises only
    // by atomics, without free-standing fences.
    moodycamel::BlockingReaderWriterCircularBuffer<Entry> entries_{capacity};
    std::atomic<std::uint64_t> lost_{0};
};

} // namespace hapnet::peer::loop
