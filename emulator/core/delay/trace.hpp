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

/// Delays as they were recorded, one after the other.
///
/// By packet: value n is the delay of datagram n, and after the last value the first one follows.
/// By time: a value holds from its time until that of the next one, or goes there in a straight
/// line. The last one lasts as long as the one before it, then the first one follows; a single one
/// holds for ever.
class DelayTrace {
public:
    /// A trace by packet. `delays` has at least one.
    explicit DelayTrace(std::vector<base::Duration> delays);

    /// A trace by time. `times` ascend from 0, and there is one for each delay.
    DelayTrace(std::vector<base::Duration> delays, std::vector<base::Duration> times);

    /// The delay of datagram `number`, for a trace by packet. Without repetition the last value
    /// holds.
    [[nodiscard]] base::Duration of(std::uint64_t number, bool repeats = true) const;

    /// The delay at a time since the trace began, for a trace by time.
    [[nodiscard]] base::Duration at(base::Duration time, Interpolation way = Interpolation::step,
                                    bool repeats = true) const;

    [[nodiscard]] bool is_by_time() const { return axis_.has_value(); }

    /// The delays in the order of the trace.
    [[nodiscard]] const std::vector<base::Duration>& delays() const { return delays_; }

    /// The share of the packets (by packet) or of the time (by time) to which a value belongs.
    [[nodiscard]] double share(std::size_t index) const;

    friend bool operator==(const DelayTrace&, const DelayTrace&) = default;

private:
    std::vector<base::Duration> delays_;
    std::optional<TimeAxis> axis_; // nullopt: one value for each datagram
};

/// Read off a trace instead of drawn: value n for datagram n, or the value at its time; either
/// begins again at its end.
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
    /// The distribution function; ascending, the last share is 1. Straight lines count as 16 steps.
    [[nodiscard]] std::vector<Step> steps() const;

    /// Compares the contents: the same file read twice is the same law.
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

    /// Changes the law. The same trace with the same timing goes on.
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
