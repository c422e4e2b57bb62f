// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/ring.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// A line that sends one thing after another at a rate, with a drop-tail queue before it. Exact:
/// n things of b bits that follow each other take ceil(n b / rate), to the nanosecond, and a change
/// of the rate in the midst of one counts the bits that were already sent.
template <typename T>
class Bottleneck {
public:
    struct Sent {
        T item;
        base::TimePoint at; // when its last bit had left
    };

    Bottleneck(const Rate& rate, std::size_t items_max) : rate_{rate}, items_{items_max} {}

    [[nodiscard]] bool is_on() const { return rate_.bits_per_second > 0; }
    [[nodiscard]] bool is_idle() const { return items_.empty(); }

    /// Whether a payload of so many bytes would find room at the end of the queue. What is being
    /// sent does not count.
    [[nodiscard]] bool has_room(std::size_t payload_bytes) const
    {
        if (items_.empty()) return true;
        return !items_.full() &&
               waiting_bytes_ + payload_bytes + rate_.overhead_bytes <= rate_.queue_bytes_max;
    }

    /// Ensures that there is room. `now` is not before the last `now`.
    void push(const T& item, std::size_t payload_bytes, base::TimePoint now)
    {
        base::ensure(!items_.full());
        const std::size_t bytes = payload_bytes + rate_.overhead_bytes;
        const bool was_idle = items_.empty();
        items_.push({item, bytes});
        if (was_idle) {
            begin(now, 0);
        } else {
            waiting_bytes_ += bytes;
        }
    }

    /// When the one that is being sent will have left; nullopt when idle.
    [[nodiscard]] std::optional<base::TimePoint> next_sent() const
    {
        if (items_.empty()) return std::nullopt;
        if (!is_on()) return since_; // the rate was taken away: all leave at once
        const std::uint64_t nanoseconds =
            work_ / rate_.bits_per_second + (work_ % rate_.bits_per_second != 0 ? 1 : 0);
        return since_ + base::Duration{static_cast<base::Duration::rep>(nanoseconds)};
    }

    /// The next that has left by `now`. What is left over when the rate is taken away leaves at
    /// once, also for who asks with the time of an arrival just before that.
    [[nodiscard]] std::optional<Sent> pop(base::TimePoint now)
    {
        const auto at = next_sent();
        if (!at || (is_on() && *at > now)) return std::nullopt;
        const auto passed = static_cast<std::uint64_t>((*at - since_).count());
        const std::uint64_t spare = is_on() ? passed * rate_.bits_per_second - work_ : 0;
        const Item item = items_.pop();
        if (!items_.empty()) {
            waiting_bytes_ -= items_.front().bytes;
            begin(*at, spare);
        }
        return Sent{item.item, *at};
    }

    /// Another rate from `now` on, for what waits and for the rest of what is being sent. All that
    /// has left by `now` has to be popped before.
    void change(const Rate& rate, base::TimePoint now)
    {
        if (!items_.empty() && is_on() && now > since_) {
            const auto passed = static_cast<std::uint64_t>((now - since_).count());
            work_ -= std::min(work_, passed * rate_.bits_per_second);
        }
        since_ = std::max(since_, now);
        rate_ = rate;
    }

private:
    struct Item {
        T item;
        std::size_t bytes = 0; // with overhead
    };

    /// Starts to send the front. `spare`: what the line could have sent in the part of a nanosecond
    /// by which the one before it was rounded up.
    void begin(base::TimePoint now, std::uint64_t spare)
    {
        constexpr std::uint64_t work_per_byte = 8 * 1'000'000'000ULL;
        const std::uint64_t work = items_.front().bytes * work_per_byte;
        work_ = work - std::min(spare, work);
        since_ = now;
    }

    Rate rate_;
    Ring<Item> items_; // the front is being sent
    std::size_t waiting_bytes_ = 0;
    std::uint64_t work_ = 0; // of the front at since_, in bits / 10^9: rate times nanoseconds
    base::TimePoint since_{};
};

} // namespace hapnet::emulator
