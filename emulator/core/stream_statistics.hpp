// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/datagram.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/core/over_time.hpp"
#include "proto/base/figures/age.hpp"
#include "proto/base/figures/arrivals.hpp"
#include "proto/base/figures/delay_meter.hpp"
#include "proto/base/figures/moments.hpp"
#include "proto/base/figures/quantiles.hpp"
#include "proto/base/figures/reorder_extents.hpp"
#include "proto/base/figures/tally.hpp"
#include "proto/base/histogram.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// Departures that follow each other within less than this time are clumped.
inline constexpr base::Duration clump_gap = std::chrono::microseconds{50};

/// The measurements of one direction of a stream, from the viewpoint of a control loop that takes
/// its input from the stream. nullopt where there was nothing to measure. Copies are not counted.
struct StreamReport {
    /// The requested law, before queues and the order policy: the drawn delays of the datagrams
    /// that were to be delivered.
    std::optional<base::Moments> requested_delay;
    /// The resulting law: the one-way delays (RFC 7679) from arrival to departure.
    std::optional<base::Moments> delay;
    std::optional<base::Quantiles> delay_quantiles;
    /// Delay variation (RFC 3393): |delay - delay of the datagram that departed just before|.
    std::optional<base::Quantiles> delay_variation;
    /// The time from each departure to the next.
    std::optional<base::Quantiles> gap;
    /// The share of these gaps that are shorter than clump_gap, from 0 to 1.
    std::optional<double> clumped_share;

    /// Runs of updates that were missing when a later one departed, whether they were lost or
    /// departed later: a loop that uses the newest update no longer needs them. They are the
    /// numbers between an in-order departure (RFC 4737, 3.3) and the previous one, or the
    /// beginning.
    base::Tally missing_runs;
    /// Reordered departures (RFC 4737, 3.3) by their extents (4.2), which count departures.
    base::Tally reordered;
    /// The number of these extents that may be too small; see base::ReorderExtents.
    std::uint64_t beyond_look_back = 0;

    /// The age of information at the output, counted from the arrival of updates, between the first
    /// and the last in-order departure.
    base::Age age;
};

/// The measurements of one direction so far.
struct StreamTotals {
    base::RunningMoments requested;
    base::RunningMoments delay;
    base::DelayMeter<base::SnapshotHistogram> delays; // one-way delays
    base::SnapshotHistogram gaps;
    std::uint64_t clumped = 0;
    base::Tally missing_runs;
    base::Tally reordered;
    std::uint64_t beyond_look_back = 0;
    base::AgeMeter age;
    std::optional<OverTime> over_time{}; // nullopt: not asked for

    [[nodiscard]] StreamReport report() const;
};

/// The extent to which a stream is measured. Each level includes the ones before it.
enum class StreamDetail { nothing, totals, over_time };

/// Measures one direction during the run, in memory of a fixed size.
class StreamStatistics {
public:
    explicit StreamStatistics(StreamDetail detail = StreamDetail::totals,
                              base::TimePoint start = {})
        : detail_{detail}
    {
        if (detail == StreamDetail::over_time) totals_.over_time.emplace(start);
    }

    /// Notes that the datagram that arrived was given this fate.
    void on_packet(const Fate& fate, base::TimePoint arrival)
    {
        if (detail_ == StreamDetail::nothing) return;
        if (!fate.drop) totals_.requested.add(fate.delay);
        if (detail_ == StreamDetail::over_time) ++totals_.over_time->at(arrival).received;
    }

    /// Notes that a datagram was dropped. Do not call it for copies.
    void on_dropped(base::TimePoint at)
    {
        if (detail_ == StreamDetail::over_time) ++totals_.over_time->at(at).dropped;
    }

    /// Notes that the line of a rate began to send, at `begun`, a datagram that arrived at
    /// `arrival`.
    void on_begun(base::TimePoint arrival, base::TimePoint begun)
    {
        if (detail_ != StreamDetail::over_time) return;
        Stretch& stretch = totals_.over_time->at(begun);
        stretch.queue_max = std::max(stretch.queue_max, std::optional{begun - arrival});
    }

    /// Notes that the datagram left at `at`, which is not earlier than the previous departure.
    void on_sent(const Datagram& datagram, base::TimePoint at)
    {
        if (detail_ != StreamDetail::nothing && !datagram.is_copy) add(datagram, at);
    }

    [[nodiscard]] const StreamTotals& totals() const { return totals_; }
    [[nodiscard]] StreamReport report() const { return totals_.report(); }

private:
    void add(const Datagram& datagram, base::TimePoint at);

    StreamDetail detail_;
    StreamTotals totals_;
    base::TimePoint last_sent_{}; // time of the last departure, if there was one
    base::NextExpected expected_;
    base::ReorderExtents extents_;
};

} // namespace hapnet::emulator
