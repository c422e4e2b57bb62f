// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "emulator/core/packet.hpp"
#include "emulator/core/trace/rows.hpp"
#include "emulator/core/trace/timing.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// Recorded delays, replayed in their order.
///
/// By packet: value n is the delay of datagram n, and after the last value the first one follows.
/// By time: a value is in effect from its time until the time of the next value, or is interpolated
/// linearly up to the next value. The last value lasts as long as the one before it, and then the
/// first one follows. A single value lasts for ever.
class DelayTrace {
public:
    /// Makes a trace by packet. `delays` has at least one value.
    explicit DelayTrace(std::vector<base::Duration> delays);

    /// Makes a trace by time. `times` ascend from 0, and there is one for each delay.
    DelayTrace(std::vector<base::Duration> delays, std::vector<base::Duration> times);

    /// Returns the delay of datagram `number`, for a trace by packet. Without repetition the last
    /// value lasts for ever.
    [[nodiscard]] base::Duration of(std::uint64_t number, bool repeats = true) const;

    /// Returns the delay at a time since the trace began, for a trace by time.
    [[nodiscard]] base::Duration at(base::Duration time, Interpolation way = Interpolation::step,
                                    bool repeats = true) const;

    [[nodiscard]] bool is_by_time() const { return axis_.has_value(); }

    /// Returns the delays in the order of the trace.
    [[nodiscard]] const std::vector<base::Duration>& delays() const { return delays_; }

    /// Returns the share of the packets (by packet) or of the time (by time) to which a value
    /// belongs.
    [[nodiscard]] double share(std::size_t index) const;

    friend bool operator==(const DelayTrace&, const DelayTrace&) = default;

private:
    std::vector<base::Duration> delays_;
    std::optional<TimeAxis> axis_; // nullopt: one value for each datagram
};

/// Read from a trace instead of drawn: value n for datagram n, or the value at the time of arrival.
/// The trace begins again at its end.
struct TraceLaw {
    std::string file;
    std::shared_ptr<const DelayTrace> trace; // never null
    std::string columns{};
    Interpolation interpolate = Interpolation::step;
    TraceTiming timing{};

    class Sampler;

    /// Reads the file.
    [[nodiscard]] base::Result<void> load(const base::Reading& reading);
    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    /// A value, and the share of values that are not greater.
    struct Step {
        base::Duration delay;
        double share;
    };
    /// Returns the distribution function. It ascends, and the last share is 1. A linearly
    /// interpolated part counts as 16 steps.
    [[nodiscard]] std::vector<Step> steps() const;

    /// Compares the contents: a file that was read twice gives equal laws.
    friend bool operator==(const TraceLaw&, const TraceLaw&);
};

constexpr auto fields_of(base::Tag<TraceLaw>)
{
    return base::fields(
        "trace",
        base::field("file", &TraceLaw::file, "recorded delays, by datagram or by time").required(),
        base::field("columns", &TraceLaw::columns,
                    "columns of CSV with other names: \"time=stamp:s, delay=rtt:ms\""),
        base::field("interpolate", &TraceLaw::interpolate,
                    "by time: a value holds until the next one, or goes there in a straight line"),
        base::part(&TraceLaw::timing));
}

class TraceLaw::Sampler {
public:
    explicit Sampler(const TraceLaw& law);

    [[nodiscard]] base::Duration at(const Packet& packet)
    {
        const bool repeats = clock_.timing().repeat;
        if (!trace_->is_by_time()) return trace_->of(packet.number, repeats);
        return trace_->at(clock_.on_packet(packet.at), interpolate_, repeats);
    }

    /// Changes the law. If trace and timing are the same, the trace continues.
    void change(const TraceLaw& law);

private:
    std::shared_ptr<const DelayTrace> trace_;
    Interpolation interpolate_;
    TraceClock clock_;
};

/// Reads a trace (see read_trace_rows): by time from a table with times or slots, else by packet.
/// The error names the line.
[[nodiscard]] base::Result<std::shared_ptr<const DelayTrace>>
parse_delay_trace(std::string_view text, const TableFormat& format = {});

} // namespace hapnet::emulator
