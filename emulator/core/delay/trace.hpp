// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// Delays as they were recorded, one after the other.
///
/// By packet: value n is the delay of datagram n, and after the last value the first one follows.
/// By time: a value holds from its time since the run began until that of the next one, without
/// interpolation. The last one holds as long as the one before it, then the first one follows;
/// a single one holds for ever.
class DelayTrace {
public:
    /// By packet; at least one.
    explicit DelayTrace(std::vector<base::Duration> delays);

    /// By time: as many times as delays, ascending from 0.
    DelayTrace(std::vector<base::Duration> delays, std::vector<base::Duration> times);

    [[nodiscard]] base::Duration at(const Packet& packet) const;

    [[nodiscard]] bool is_by_time() const { return !times_.empty(); }

    /// In the order of the trace.
    [[nodiscard]] const std::vector<base::Duration>& delays() const { return delays_; }

    /// The share of the packets (by packet) or of the time (by time) to which a value belongs.
    [[nodiscard]] double share(std::size_t index) const;

    friend bool operator==(const DelayTrace&, const DelayTrace&) = default;

private:
    std::vector<base::Duration> delays_;
    std::vector<base::Duration> times_; // empty: by packet
    base::Duration period_{};           // by time; 0: it has only one value
};

/// Read off a trace instead of drawn: value n for datagram n, or the value at its time; either
/// begins again at its end.
struct TraceLaw {
    std::string file;
    std::shared_ptr<const DelayTrace> trace; // never null

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
    /// The distribution function; ascending, the last share is 1.
    [[nodiscard]] std::vector<Step> steps() const;

    /// By its contents: the same file read twice is the same law.
    friend bool operator==(const TraceLaw&, const TraceLaw&);
};

constexpr auto fields_of(base::Tag<TraceLaw>)
{
    return base::fields(
        "trace",
        base::field("file", &TraceLaw::file, "recorded delays, by datagram or by time").required());
}

class TraceLaw::Sampler {
public:
    explicit Sampler(const TraceLaw& law);

    [[nodiscard]] base::Duration at(const Packet& packet) const { return trace_->at(packet); }

private:
    std::shared_ptr<const DelayTrace> trace_;
};

/// Reads a trace: by packet from one delay with its unit per line or from CSV with a column
/// delay_ns, delay_us, delay_ms or delay_s; by time from CSV that also has a column time_ns, ...,
/// time_s, ascending from 0. At most QuantileTable::values_max values. Errors name the line.
[[nodiscard]] base::Result<std::shared_ptr<const DelayTrace>>
parse_delay_trace(std::string_view text);

} // namespace hapnet::emulator
