// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/trace/rows.hpp"
#include "emulator/core/trace/timing.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::emulator {

/// The amount that a line sends, in bits times 10^9: bits a second times nanoseconds.
using Work = std::uint64_t;
inline constexpr Work work_per_byte = 8 * 1'000'000'000ULL;

/// The time when a line has finished some work, and the amount that it could have sent in addition
/// by that time: a part of a nanosecond, or of an opportunity.
struct Completion {
    base::Duration at{};
    Work spare = 0;

    friend bool operator==(const Completion&, const Completion&) = default;
};

/// Moments at which a fixed number of bytes may leave, by the rule of Mahimahi (Netravali et al.,
/// USENIX ATC 2015, src/frontend/link_queue.cc). An opportunity is lost if no datagram waits. If a
/// datagram does not fill an opportunity, the rest of it is for the next datagram that waits. A
/// larger datagram takes several opportunities. A datagram that arrives at the moment of an
/// opportunity is too late for it. The trace begins again at its last opportunity.
class Opportunities {
public:
    static constexpr std::size_t bytes_each = 1504;

    /// A moment, and the number of opportunities from the beginning up to and including it.
    struct Moment {
        base::Duration at{};
        std::uint64_t count = 0;

        friend bool operator==(const Moment&, const Moment&) = default;
    };

    /// `moments` has at least one. Both numbers ascend: times from 0 on, and the last time is above
    /// 0. It takes 16 B for each moment, whatever the number of opportunities.
    explicit Opportunities(std::vector<Moment> moments);

    [[nodiscard]] std::optional<Completion> finish(base::Duration from, Work work,
                                                   bool repeats) const;
    [[nodiscard]] Work sent(base::Duration from, base::Duration to, bool repeats) const;
    [[nodiscard]] double mean_rate() const;
    [[nodiscard]] base::Duration period() const { return moments_.back().at; }

    friend bool operator==(const Opportunities&, const Opportunities&) = default;

private:
    [[nodiscard]] std::uint64_t count(base::Duration until, bool repeats) const;

    [[nodiscard]] std::uint64_t each_round() const { return moments_.back().count; }

    std::vector<Moment> moments_;
};

/// Rates over time: each is in effect from its time until the time of the next one.
class RateSteps {
public:
    /// `times` ascend from 0, and there is one for each rate. At least one rate is above 0.
    RateSteps(std::vector<std::uint64_t> rates, std::vector<base::Duration> times);

    [[nodiscard]] std::optional<Completion> finish(base::Duration from, Work work,
                                                   bool repeats) const;
    [[nodiscard]] Work sent(base::Duration from, base::Duration to, bool repeats) const;
    [[nodiscard]] double mean_rate() const;
    [[nodiscard]] base::Duration period() const { return axis_.period(); }

    friend bool operator==(const RateSteps&, const RateSteps&) = default;

private:
    /// The rate at a time, and its remaining duration; nullopt: for ever.
    struct Segment {
        std::uint64_t rate = 0;
        std::optional<base::Duration> left;
    };
    [[nodiscard]] Segment segment(base::Duration time, bool repeats) const;

    std::vector<std::uint64_t> rates_;
    TimeAxis axis_;
    Work per_period_ = 0; // work in one period; at most 2^63
};

/// The recorded capacity of a line over time.
class RateTrace {
public:
    explicit RateTrace(std::variant<Opportunities, RateSteps> trace);

    /// Returns the time when the line has finished work that it begins at `from`, both counted from
    /// the beginning of the trace; nullopt: never, or not within 10^6 s.
    [[nodiscard]] std::optional<Completion> finish(base::Duration from, Work work,
                                                   bool repeats) const;

    /// Returns the amount that the line can send after `from`, up to and including `to`; at most
    /// 2^63.
    [[nodiscard]] Work sent(base::Duration from, base::Duration to, bool repeats) const;

    /// Returns the mean rate in bits a second.
    [[nodiscard]] double mean_rate() const;

    /// Returns the time after which the trace begins again; 0: it has one rate for ever.
    [[nodiscard]] base::Duration period() const;

    friend bool operator==(const RateTrace&, const RateTrace&) = default;

private:
    std::variant<Opportunities, RateSteps> trace_;
};

/// Reads Mahimahi's format, with a line for each opportunity that has its time in whole
/// milliseconds, or a table of times, or with slots, and of rates (see read_trace_rows). The error
/// names the line.
[[nodiscard]] base::Result<RateTrace> parse_rate_trace(std::string_view text,
                                                       const TableFormat& format = {});

/// The rate of a bottleneck, read from a trace.
struct RateTraceLaw {
    std::string file;
    std::shared_ptr<const RateTrace> trace; // never null
    std::string columns{};
    TraceTiming timing{};

    /// Reads the file.
    [[nodiscard]] base::Result<void> load(const base::Reading& reading);
    [[nodiscard]] base::Result<void> validate() const;

    /// Compares the contents: a file that was read twice gives equal laws.
    friend bool operator==(const RateTraceLaw& a, const RateTraceLaw& b);
};

constexpr auto fields_of(base::Tag<RateTraceLaw>)
{
    return base::fields(
        "trace",
        base::field("file", &RateTraceLaw::file,
                    "opportunities of 1504 B, a time in ms a line (Mahimahi), or CSV of times and "
                    "rates")
            .required(),
        base::field("columns", &RateTraceLaw::columns,
                    "columns of CSV with other names: \"time=stamp:s, rate=capacity:Mbps\""),
        base::part(&RateTraceLaw::timing));
}

} // namespace hapnet::emulator
