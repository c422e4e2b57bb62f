// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/buffer_pool.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/datagram.hpp"
#include "emulator/core/delay_line.hpp"
#include "emulator/core/pipeline.hpp"
#include "emulator/core/statistics.hpp"
#include "emulator/core/verdict.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::emulator {

/// One direction of an emulated path. Does no I/O and reads no clock: feed it with on_packet(),
/// drain it with poll(), and call again by next_deadline(). Every datagram that poll() gives out
/// comes back through on_sent() or on_failed(); until then it counts as in flight.
class Link {
public:
    explicit Link(Pipeline pipeline, Order order = Order::keep, QueueLimits limits = {});

    /// Takes the next datagram of this direction, which arrived at `arrival`, and says what is to
    /// become of it. With Order::keep a datagram may leave later than Deliver::after says, behind
    /// the one before it.
    Verdict on_packet(std::span<const std::byte> bytes, base::TimePoint arrival);

    /// A datagram that is due at `now`, the earliest first; nullopt when there is none.
    [[nodiscard]] std::optional<Datagram> poll(base::TimePoint now);

    /// When the next datagram is due; nullopt when none is in flight.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const { return line_.next_due(); }

    /// The datagram left at `at`.
    void on_sent(Datagram&& datagram, base::TimePoint at);

    /// The datagram could not be sent.
    void on_failed(Datagram&& datagram, DropCause cause);

    [[nodiscard]] const Statistics& statistics() const { return statistics_; }

private:
    void enqueue(std::span<const std::byte> bytes, base::TimePoint arrival, base::Duration after);

    Pipeline pipeline_;
    Order order_;
    DelayLine line_;
    BufferPool buffers_;
    base::TimePoint last_due_ = base::TimePoint::min();
    std::uint64_t beyond_highest_delivered_ = 0; // the highest number that left, plus one
    Statistics statistics_;
};

} // namespace hapnet::emulator
