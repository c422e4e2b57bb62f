// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// The moment of a run at which a trace has its time 0.
enum class TraceStart : std::uint8_t {
    run,   // time 0 is the start of the run
    first, // time 0 is the first arrival in the direction
};
constexpr auto names_of(base::Tag<TraceStart>) { return base::names("run", "first"); }

/// The value of a trace between two entries.
enum class Interpolation : std::uint8_t { step, linear };
constexpr auto names_of(base::Tag<Interpolation>) { return base::names("step", "linear"); }

/// The position of a trace in the time of a run.
struct TraceTiming {
    bool repeat = true;
    base::Duration offset{}; // not negative
    TraceStart start = TraceStart::run;
    base::Duration slot{}; // length of each value; 0: the file has times

    friend bool operator==(const TraceTiming&, const TraceTiming&) = default;
};
constexpr auto fields_of(base::Tag<TraceTiming>)
{
    return base::fields(
        "timing",
        base::field("repeat", &TraceTiming::repeat,
                    "whether the trace begins again at its end; if not, its last value holds"),
        base::field("offset", &TraceTiming::offset, "how far into the trace the run begins"),
        base::field("start", &TraceTiming::start,
                    "whether the trace begins with the run, or with the first datagram"),
        base::field("slot", &TraceTiming::slot,
                    "how long each value of a file without times lasts; 0: the file has times"));
}

/// Maps a moment of the run to a moment of the trace.
class TraceClock {
public:
    explicit TraceClock(const TraceTiming& timing) : timing_{timing} {}

    /// Returns the place in the trace for a datagram that arrives at `at` since the run began.
    /// Arrivals must not go back in time.
    [[nodiscard]] base::Duration on_packet(base::Duration at)
    {
        if (!zero_) zero_ = timing_.start == TraceStart::first ? at : base::Duration{0};
        return std::max(at - *zero_, base::Duration{0}) + timing_.offset;
    }

    [[nodiscard]] const TraceTiming& timing() const { return timing_; }

private:
    TraceTiming timing_;
    std::optional<base::Duration> zero_; // nullopt: no datagram has come yet
};

/// The times of the values of a trace. The last value lasts as long as the one before it. A single
/// value lasts for ever.
class TimeAxis {
public:
    /// Takes times that ascend from 0; at least one.
    explicit TimeAxis(std::vector<base::Duration> times);

    /// The position of a moment: the index of the value at or before it, and the share of the time
    /// to the next value that has passed. The share of a value that lasts for ever is 0.
    struct Place {
        std::size_t index = 0;
        std::size_t next = 0;
        double progress = 0.0;
    };
    [[nodiscard]] Place place(base::Duration time, bool repeats) const;

    [[nodiscard]] std::size_t size() const { return times_.size(); }

    /// Returns the time after which the trace begins again; 0: it has only one value.
    [[nodiscard]] base::Duration period() const { return period_; }
    [[nodiscard]] base::Duration begin(std::size_t index) const { return times_[index]; }
    [[nodiscard]] base::Duration end(std::size_t index) const
    {
        return index + 1 < times_.size() ? times_[index + 1] : period_;
    }

    /// Returns the share of a period that a value lasts.
    [[nodiscard]] double share(std::size_t index) const;

    friend bool operator==(const TimeAxis&, const TimeAxis&) = default;

private:
    std::vector<base::Duration> times_;
    base::Duration period_{};
};

} // namespace hapnet::emulator
