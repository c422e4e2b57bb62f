// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/nearest.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// Numbers the ticks of a peer such that all peers use the same numbers, although their clocks
/// differ by a few milliseconds. Number 0 is the first tick of the peers that were present at the
/// start. Ticks are counted, because counting is exact and clocks are not. Only for a peer that
/// joins late, or has missed many ticks, one number is taken from the clock, and later ones are
/// counted from there.
class SessionTicks {
public:
    /// The tolerance between the count of ticks and the clock. A peer that is late by less was
    /// present at the start, because agreed starts differ by less.
    static constexpr base::Duration in_time{std::chrono::milliseconds{50}};

    /// Returns the number in the session of a peer's tick. The peer has played `count` ticks before
    /// it, and the clock shows `since_start` since the session's start.
    [[nodiscard]] std::int64_t number(std::int64_t count, base::Duration since_start,
                                      base::Duration tick)
    {
        const double by_clock = base::to_seconds(since_start) / base::to_seconds(tick);
        const double apart = by_clock - static_cast<double>(count + missing_);
        if (std::abs(apart) * base::to_seconds(tick) > base::to_seconds(in_time))
            missing_ += base::nearest(apart);
        return count + missing_;
    }
    void forget() { missing_ = 0; }

private:
    std::int64_t missing_ = 0; // ticks of the session that the peer did not play
};

} // namespace hapnet::peer
