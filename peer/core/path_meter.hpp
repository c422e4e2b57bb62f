// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/clock_sync.hpp"
#include "proto/base/figures/age.hpp"
#include "proto/base/figures/arrivals.hpp"
#include "proto/base/figures/delay_meter.hpp"
#include "proto/base/figures/moments.hpp"
#include "proto/base/figures/quantiles.hpp"
#include "proto/base/histogram.hpp"
#include "proto/base/recent_numbers.hpp"
#include "proto/wire/message.hpp"

#include <cstddef>
#include <optional>

namespace hapnet::peer {

/// The effect of the path on the states of one direction. Delays and ages need the remote's clock,
/// so none are added while it is unknown or in doubt. nullopt: not measured.
struct PathReport {
    std::optional<base::Quantiles> delay;
    /// |difference of the delays| of consecutive states (RFC 3393).
    std::optional<base::Quantiles> jitter;
    /// The age of the newest state that has arrived.
    base::Age age;
};

/// The reports of both directions between this peer and another.
struct PathsReport {
    base::ArrivalCounts arrived; // states of the other peer
    std::optional<double> loss;  // share of arrived.sent that was lost, 0 to 1
    PathReport in;
    PathReport out; // for states that were the newest at the other peer when it sent
};

/// Measures both directions between this peer and another from the states that arrive, in 80 KiB.
/// Adding never allocates.
class PathMeter {
public:
    /// The number of newer states after which a duplicate is counted as a new arrival.
    static constexpr std::size_t looks_back = 1024;

    /// Adds a state of the session that has arrived, even if it is not used. `clock` is the
    /// remote's clock, if it is known.
    void on_state(const wire::State& state, base::TimePoint arrived,
                  const std::optional<ClockEstimate>& clock);

    [[nodiscard]] PathsReport report() const;

private:
    using DelayMeter = base::DelayMeter<base::DurationHistogram>;

    void on_newest(const wire::State& state, base::TimePoint arrived, base::Duration ahead);
    void on_echo(const wire::Echo& echo, base::TimePoint sent, base::Duration ahead);

    base::RecentNumbers<looks_back> numbers_;
    base::ArrivalCounter arrivals_{1};
    DelayMeter in_;
    base::AgeMeter age_;

    DelayMeter out_;
    std::optional<base::TimePoint> echoed_; // stamp of this peer's newest message that was echoed
    base::RunningMoments ages_there_; // ages of this peer's newest message when the other peer sent
    base::Duration age_there_peak_{};
};

} // namespace hapnet::peer
