// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/clock_sync.hpp"
#include "proto/base/histogram.hpp"
#include "proto/wire/message.hpp"

#include <bitset>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// A distribution of times; its quantiles err by at most 1.6 %.
struct TimeQuantiles {
    base::Duration p50{};
    base::Duration p99{};
    base::Duration max{};
};

/// Age of information (Kaul, Yates, Gruteser, "Real-time status: how often should one update?",
/// 2012): how long ago the newest state that has arrived was sent.
struct StateAge {
    base::Duration mean{};     // over time
    base::Duration peak_max{}; // just before a newer one arrived
};

/// What the path did to the states of one direction. Delays and ages need the other side's clock:
/// while it is unknown or in doubt nothing is added to them. nullopt: nothing was measured.
struct PathReport {
    std::optional<TimeQuantiles> delay;
    /// |difference of the delays| of states that came one after another (RFC 3393).
    std::optional<TimeQuantiles> jitter;
    std::optional<StateAge> age;
};

/// The states that have come.
struct ArrivalCounts {
    std::uint64_t sent = 0;     // by the highest number among them
    std::uint64_t received = 0; // different ones
    std::uint64_t duplicates = 0;
    std::uint64_t reordered = 0; // came after one with a higher number (RFC 4737)
    std::optional<double> loss;  // share of `sent` that never came, 0 to 1
};

/// Both directions between this peer and another.
struct PathsReport {
    ArrivalCounts arrived;
    PathReport in;
    PathReport out; // of those that were the newest over there when it sent something
};

/// Measures both directions between this peer and another from the states that arrive, as it goes,
/// in 80 KiB: adding never allocates.
class PathMeter {
public:
    /// A duplicate that comes after so many newer ones counts as received.
    static constexpr std::size_t looks_back = 1024;

    /// A state of the session arrived, whether it is used or not. `clock`: the other side's, as far
    /// as it is known.
    void on_state(const wire::State& state, base::TimePoint arrived,
                  const std::optional<ClockEstimate>& clock);

    [[nodiscard]] PathsReport report() const;

private:
    /// Delays one after another, and what they vary by.
    class Delays {
    public:
        /// `apart`: arrival minus sending, each on its own clock; `ahead`: the first one's lead.
        void add(base::Duration apart, base::Duration ahead);
        /// The next has none to be compared with.
        void pause() { before_.reset(); }
        void report_to(PathReport& report) const;

    private:
        base::DurationHistogram delay_;
        base::DurationHistogram jitter_;
        std::optional<base::Duration> before_; // as `apart`
    };

    [[nodiscard]] bool is_duplicate(std::uint32_t sequence);
    void on_newest(const wire::State& state, base::TimePoint arrived, base::Duration ahead);
    void on_echo(const wire::Echo& echo, base::TimePoint sent, base::Duration ahead);

    std::uint32_t highest_ = 0;
    std::bitset<looks_back> seen_; // of the last numbers up to the highest, by their lowest bits
    std::uint64_t received_ = 0;
    std::uint64_t duplicates_ = 0;
    std::uint64_t reordered_ = 0;

    Delays in_;
    struct Newest {
        base::TimePoint arrived;
        base::Duration delay{};
    };
    std::optional<Newest> newest_; // since the clock is known
    double age_area_s2_ = 0.0;     // the age, integrated over the time below
    double age_time_s_ = 0.0;
    base::Duration age_peak_{};

    Delays out_;
    std::optional<base::TimePoint> echoed_; // the newest of ours that was
    double age_there_s_ = 0.0;              // the sum at the moments when it sent
    std::uint64_t ages_there_ = 0;
    base::Duration age_there_peak_{};
};

} // namespace hapnet::peer
