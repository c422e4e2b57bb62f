// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <optional>

namespace hapnet::peer {

/// A measurement of the other side's clock by one echoed message.
struct ClockSample {
    base::TimePoint sent;         // by us, our clock
    base::TimePoint heard;        // by them, their clock
    base::TimePoint answered;     // by them, their clock
    base::TimePoint answer_heard; // by us, our clock
};

/// Estimates how far the other side's clock is ahead of ours, from echoes (NTP's offset, RFC 5905
/// section 8). Trusts the sample with the shortest round trip among the last one to two seconds:
/// queueing delays both lengthen the trip and spoil the offset.
class ClockOffset {
public:
    struct Estimate {
        base::Duration offset;      // their clock minus ours
        base::Duration uncertainty; // half the round trip: bounds what asymmetry can hide
    };

    /// Ignores samples with a negative round trip or an offset of more than ten years.
    void add(const ClockSample& sample);

    /// nullopt before the first sample.
    [[nodiscard]] std::optional<Estimate> estimate() const;

    void reset() { *this = ClockOffset{}; }

private:
    static constexpr base::Duration window{std::chrono::seconds{1}};

    struct Sample {
        base::Duration offset;
        base::Duration round_trip;
    };
    std::optional<Sample> best_now_;
    std::optional<Sample> best_before_;
    base::TimePoint window_start_;
};

} // namespace hapnet::peer
