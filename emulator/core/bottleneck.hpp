// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/datagram.hpp"
#include "emulator/core/ring.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// A line that sends one datagram after another at a rate, with a drop-tail queue before it. Exact:
/// n of b bits that follow each other take ceil(n b / rate), to the nanosecond, and a change of the
/// rate in the midst of one counts the bits that were already sent.
class Bottleneck {
public:
    Bottleneck(const Rate& rate, std::size_t datagrams_max) : rate_{rate}, queue_{datagrams_max} {}

    [[nodiscard]] bool is_on() const { return rate_.bits_per_second > 0; }
    [[nodiscard]] bool is_idle() const { return queue_.empty(); }

    /// Whether a payload of so many bytes would find room at the end of the queue. What is being
    /// sent does not count.
    [[nodiscard]] bool has_room(std::size_t payload_bytes) const
    {
        if (queue_.empty()) return true;
        return !queue_.full() &&
               waiting_bytes_ + payload_bytes + rate_.overhead_bytes <= rate_.queue_bytes_max;
    }

    /// Takes a datagram that arrives now, not before the last one. Ensures that there is room.
    void push(const Datagram& datagram, const Fate& fate)
    {
        base::ensure(!queue_.full());
        const std::size_t line_bytes = datagram.size() + rate_.overhead_bytes;
        const bool was_idle = queue_.empty();
        queue_.push({datagram, fate, line_bytes});
        if (was_idle) {
            begin(datagram.arrival, 0);
        } else {
            waiting_bytes_ += line_bytes;
        }
    }

    /// When the one that is being sent will have left; nullopt when idle.
    [[nodiscard]] std::optional<base::TimePoint> next_sent() const
    {
        if (queue_.empty()) return std::nullopt;
        if (!is_on()) return since_; // the rate was taken away: all leave at once
        const std::uint64_t nanoseconds =
            work_ / rate_.bits_per_second + (work_ % rate_.bits_per_second != 0 ? 1 : 0);
        return since_ + base::Duration{static_cast<base::Duration::rep>(nanoseconds)};
    }

    /// The next that has left by `now`; due: when its last bit had left. What is left over when the
    /// rate is taken away leaves at once, also by the time of an arrival just before that.
    [[nodiscard]] std::optional<Queued> pop(base::TimePoint now)
    {
        const auto at = next_sent();
        if (!at || (is_on() && *at > now)) return std::nullopt;
        const auto passed = static_cast<std::uint64_t>((*at - since_).count());
        const std::uint64_t spare = is_on() ? passed * rate_.bits_per_second - work_ : 0;
        Queued sent = queue_.pop();
        sent.datagram.due = *at;
        if (!queue_.empty()) {
            waiting_bytes_ -= queue_.front().line_bytes;
            begin(*at, spare);
        }
        return sent;
    }

    /// Another rate from `now` on, for what waits and for the rest of what is being sent. All that
    /// has left by `now` has to be popped before.
    void change(const Rate& rate, base::TimePoint now)
    {
        if (!queue_.empty() && is_on() && now > since_) {
            const auto passed = static_cast<std::uint64_t>((now - since_).count());
            work_ -= std::min(work_, passed * rate_.bits_per_second);
        }
        since_ = std::max(since_, now);
        rate_ = rate;
    }

private:
    /// Starts to send the front. `spare`: what the line could have sent in the part of a nanosecond
    /// by which the one before it was rounded up.
    void begin(base::TimePoint now, std::uint64_t spare)
    {
        constexpr std::uint64_t work_per_byte = 8 * 1'000'000'000ULL;
        const std::uint64_t work = queue_.front().line_bytes * work_per_byte;
        work_ = work - std::min(spare, work);
        since_ = now;
    }

    Rate rate_;
    Ring<Queued> queue_; // the front is being sent
    std::size_t waiting_bytes_ = 0;
    std::uint64_t work_ = 0; // of the front at since_, in bits / 10^9: rate times nanoseconds
    base::TimePoint since_{};
};

} // namespace hapnet::emulator
