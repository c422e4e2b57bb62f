// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/figures/moments.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// Times from arrival to departure.
struct DelaySpread {
    base::Duration min{};
    base::Duration mean{};
    base::Duration max{};
};
constexpr auto fields_of(base::Tag<DelaySpread>)
{
    return base::fields("delay spread", base::member("min", &DelaySpread::min),
                        base::member("mean", &DelaySpread::mean),
                        base::member("max", &DelaySpread::max));
}

/// Times sent minus times due.
struct LateSpread {
    base::Duration mean{};
    base::Duration max{};
};
constexpr auto fields_of(base::Tag<LateSpread>)
{
    return base::fields("late spread", base::member("mean", &LateSpread::mean),
                        base::member("max", &LateSpread::max));
}

/// The departures of one direction of a path since the last look: how long they were in the
/// emulator, and how late they left. It has a fixed size. A datagram costs four additions and two
/// comparisons.
struct Pulse {
    std::uint64_t count = 0;
    base::Duration delay_min = base::Duration::max();
    base::Duration delay_max = base::Duration::min();
    base::Duration late_max = base::Duration::min();
    double delay_sum_ns = 0.0; // floating point: sums of long delays do not overflow
    double late_sum_ns = 0.0;

    void on_sent(base::Duration delay, base::Duration late)
    {
        ++count;
        delay_min = std::min(delay_min, delay);
        delay_max = std::max(delay_max, delay);
        late_max = std::max(late_max, late);
        delay_sum_ns += base::to_nanoseconds(delay);
        late_sum_ns += base::to_nanoseconds(late);
    }

    void add(const Pulse& later)
    {
        count += later.count;
        delay_min = std::min(delay_min, later.delay_min);
        delay_max = std::max(delay_max, later.delay_max);
        late_max = std::max(late_max, later.late_max);
        delay_sum_ns += later.delay_sum_ns;
        late_sum_ns += later.late_sum_ns;
    }

    /// Returns the delays of the departures; nullopt: nothing has left.
    [[nodiscard]] std::optional<DelaySpread> delay() const
    {
        if (count == 0) return std::nullopt;
        return DelaySpread{delay_min, mean(delay_sum_ns), delay_max};
    }
    [[nodiscard]] std::optional<LateSpread> late() const
    {
        if (count == 0) return std::nullopt;
        return LateSpread{mean(late_sum_ns), late_max};
    }

private:
    [[nodiscard]] base::Duration mean(double sum_ns) const
    {
        return base::nearest_duration(sum_ns / static_cast<double>(count));
    }
};

} // namespace hapnet::emulator
