// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/peer.hpp"
#include "peer/monitor/device_news.hpp"
#include "proto/record/rows.hpp"

#include <atomic>
#include <readerwriterqueue/readerwritercircularbuffer.h>
#include <variant>

namespace hapnet::peer {

/// Something a person should be told, and when it happened.
struct Happening {
    Event event = Event::met;
    base::TimePoint at;
};

/// The same, of the device.
struct DeviceHappening {
    DeviceNews news;
    base::TimePoint at;
};

/// What leaves the servo thread for the record, the status line and the log.
using Entry = std::variant<record::Row, Happening, DeviceHappening>;

/// The one way out of the servo thread: a bounded queue that never makes it wait. What does not
/// fit is counted, not waited for.
class Journal {
public:
    /// Servo side.
    void put(const Entry& entry)
    {
        if (!entries_.try_enqueue(entry)) lost_.fetch_add(1, std::memory_order_relaxed);
    }

    /// The other side; nullopt when nothing is waiting.
    [[nodiscard]] std::optional<Entry> take()
    {
        Entry entry;
        if (!entries_.try_dequeue(entry)) return std::nullopt;
        return entry;
    }

    [[nodiscard]] std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

private:
    // 8 s of ticks and messages: longer than any stall of a disk that we want to survive.
    static constexpr std::size_t capacity = 16384;

    // Of the two queues of its package the one that ThreadSanitizer can follow: it synchronises by
    // atomics alone, without free-standing fences.
    moodycamel::BlockingReaderWriterCircularBuffer<Entry> entries_{capacity};
    std::atomic<std::uint64_t> lost_{0};
};

} // namespace hapnet::peer
