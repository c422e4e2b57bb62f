// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/datagram.hpp"
#include "emulator/core/fate.hpp"
#include "proto/base/histogram.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// Departures that follow each other sooner than this come as a clump.
inline constexpr base::Duration clump_gap = std::chrono::microseconds{50};

/// How many in-order departures the extent of a reordering is looked for.
inline constexpr std::size_t reorder_look_back = 1024;

struct Moments {
    base::Duration mean{};
    std::optional<base::Duration> sd; // of the sample (n - 1); nullopt for a single value
};

/// To 1.6 %, the largest one exactly.
struct Quantiles {
    base::Duration p50{};
    base::Duration p90{};
    base::Duration p99{};
    base::Duration p999{};
    base::Duration max{};
};

/// What a stream looks like to a loop that is fed by it, one direction. nullopt where nothing was
/// there to be measured. Copies count nowhere.
struct StreamReport {
    /// The law that was asked for, before queues and the order policy: the drawn delays of those
    /// that were to be delivered.
    std::optional<Moments> requested_delay;
    /// The law that was realised: the one-way delays (RFC 7679) from arrival to departure.
    std::optional<Moments> delay;
    std::optional<Quantiles> delay_quantiles;
    /// Delay variation (RFC 3393): |delay - delay of the one that departed just before|.
    std::optional<Quantiles> delay_variation;
    /// From each departure to the next.
    std::optional<Quantiles> gap;
    /// The share of these gaps that are shorter than clump_gap, from 0 to 1.
    std::optional<double> clumped_share;

    /// Runs of updates that were missing when a later one departed, whether lost or still to
    /// come: a loop that uses the newest has no use for them any more. The numbers between an
    /// in-order departure (RFC 4737, 3.3) and the one before it, or the beginning.
    std::uint64_t missing_runs = 0;
    std::optional<double> missing_run_mean; // in updates
    std::uint64_t missing_run_max = 0;

    /// Reordered departures (RFC 4737, 3.3) and their extents (4.2): how many departures after
    /// the first one with a higher number they came.
    std::uint64_t reordered = 0;
    std::optional<double> reorder_extent_mean; // in departures
    std::uint64_t reorder_extent_max = 0;
    /// Those for which that first one may lie further back than reorder_look_back in-order
    /// departures: their extents are counted from there, and may be too small.
    std::uint64_t beyond_look_back = 0;

    /// Age of information (Kaul, Yates, Gruteser, "Real-time status: how often should one
    /// update?", 2012) at the output: time since the arrival of the newest update that has
    /// departed. The mean over the time from the first to the last in-order departure, and the
    /// mean and the maximum of the peaks, just before each in-order departure but the first.
    std::optional<base::Duration> age_mean;
    std::optional<base::Duration> peak_age_mean;
    std::optional<base::Duration> peak_age_max;
};

/// What has been measured of one direction so far.
struct StreamTotals {
    /// Mean and variance in one pass (Welford 1962), in nanoseconds.
    struct Running {
        std::uint64_t count = 0;
        double mean = 0.0;
        double squares = 0.0; // of the deviations from the mean

        void add(base::Duration value);
        [[nodiscard]] std::optional<Moments> moments() const;
    };

    Running requested;
    Running delay;
    base::SnapshotHistogram delays; // one-way
    base::SnapshotHistogram variations;
    base::SnapshotHistogram gaps;
    std::uint64_t clumped = 0;
    std::uint64_t missing_runs = 0;
    std::uint64_t missing = 0;
    std::uint64_t missing_run_max = 0;
    std::uint64_t reordered = 0;
    std::uint64_t extents = 0; // their sum
    std::uint64_t extent_max = 0;
    std::uint64_t beyond_look_back = 0;
    base::Duration fresh_time{}; // from the first to the last in-order departure
    double age_area = 0.0;       // nanoseconds squared
    Running peaks;
    base::Duration peak_max{};

    [[nodiscard]] StreamReport report() const;
};

/// Measures one direction as it goes, in memory of a fixed size.
class StreamStatistics {
public:
    /// The datagram that arrived was given this fate.
    void on_packet(const Fate& fate);

    /// The datagram left at `at`, not before the one that left before it.
    void on_sent(const Datagram& datagram, base::TimePoint at);

    [[nodiscard]] const StreamTotals& totals() const { return totals_; }
    [[nodiscard]] StreamReport report() const { return totals_.report(); }

private:
    /// An in-order departure.
    struct Record {
        std::uint64_t number = 0;
        std::uint64_t place = 0; // among all departures
    };

    /// When a datagram came and left.
    struct Times {
        base::TimePoint arrival{};
        base::TimePoint sent{};
    };

    void in_order(std::uint64_t number, const Times& times);
    void out_of_order(std::uint64_t number);
    void remember(const Record& record);

    StreamTotals totals_;
    std::optional<Times> last_;
    std::uint64_t departures_ = 0;
    std::uint64_t beyond_highest_ = 0;                // the highest number that departed, plus one
    std::array<Record, reorder_look_back> records_{}; // a ring, ascending in number and place
    std::uint64_t recorded_ = 0;
    std::optional<Times> freshest_; // the last in-order departure
};

} // namespace hapnet::emulator
