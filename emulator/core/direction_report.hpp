// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/regime_chain.hpp"
#include "emulator/core/statistics.hpp"
#include "emulator/core/stream_statistics.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"
#include "proto/base/value_kind.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The non-empty bins of a histogram: each has its lower bound (included), its upper bound
/// (excluded), both in the unit of the enclosing key, and its count.
using Distribution = std::vector<std::array<double, 3>>;
[[nodiscard]] Distribution distribution_of(const base::DurationHistogram& histogram,
                                           double ns_per_unit);

/// A histogram of times, as statistics report it.
struct TimesReport {
    const base::DurationHistogram* of = nullptr;
    std::optional<Distribution> distribution;

    [[nodiscard]] std::optional<base::Duration> quantile(double q) const { return of->quantile(q); }
};
constexpr auto fields_of(base::Tag<TimesReport>)
{
    using T = TimesReport;
    return base::fields(
        "times", base::computed<T>("p50", [](const T& times) { return times.quantile(0.5); }),
        base::computed<T>("p90", [](const T& times) { return times.quantile(0.9); }),
        base::computed<T>("p99", [](const T& times) { return times.quantile(0.99); }),
        base::computed<T>("p999", [](const T& times) { return times.quantile(0.999); }),
        base::computed<T>("max", [](const T& times) { return times.of->max(); }),
        base::member("distribution", &T::distribution,
                     "With --fates, at the end of the run: a list of [low, high, count], values "
                     "from low on and below high, 1.6 % wide.")
            .left_out_if_none());
}

/// The report on the delays of a stream.
struct DelayReport {
    base::Moments moments;
    base::Quantiles quantiles;
    std::optional<Distribution> distribution;
};
constexpr auto fields_of(base::Tag<DelayReport>)
{
    return base::fields("delays", base::part(&DelayReport::moments),
                        base::part(&DelayReport::quantiles),
                        base::member("distribution", &DelayReport::distribution,
                                     "With --fates, at the end of the run, as of `lateness_us`.")
                            .left_out_if_none());
}

/// Reordered departures.
struct ReorderReport {
    base::Tally extents;
    std::uint64_t beyond_look_back = 0;
};
constexpr auto fields_of(base::Tag<ReorderReport>)
{
    return base::fields("reorder extents", base::part(&ReorderReport::extents),
                        base::member("beyond_look_back", &ReorderReport::beyond_look_back,
                                     "Those whose extent may be larger: the search ends 1024 "
                                     "departures back."));
}

/// The shape of a stream, as statistics report it.
struct StreamShape {
    StreamReport measured;
    std::optional<Distribution> distribution; // distribution of the delays
    std::optional<std::vector<StretchReport>> over_time;

    [[nodiscard]] std::optional<DelayReport> delay() const;
};
constexpr auto fields_of(base::Tag<StreamShape>)
{
    using L = StreamShape;
    return base::fields(
        "lens",
        base::computed<L>(
            "requested_delay_ms",
            [](const L& lens) -> const auto& { return lens.measured.requested_delay; },
            "The delays as drawn, before queues and order, of all datagrams that no law dropped. "
            "`mean` and `sd` (of the sample) are of all values; `sd` is null for a single one. "
            "null: nothing was to be delivered.")
            .told("delay as drawn"),
        base::computed<L>(
            "delay_ms", [](const L& lens) { return lens.delay(); },
            "The delays as they came out, from receive stamp to sending (RFC 7679). null: nothing "
            "left.")
            .told("delay as it came out"),
        base::computed<L>(
            "delay_variation_ms",
            [](const L& lens) -> const auto& { return lens.measured.delay_variation; },
            "|IPDV|: the delay minus that of the datagram that left just before (RFC 3393). null: "
            "fewer than two left."),
        base::computed<L>(
            "gap_ms", [](const L& lens) -> const auto& { return lens.measured.gap; },
            "The time between two departures. null: fewer than two left."),
        base::computed<L>(
            "clumped", [](const L& lens) { return lens.measured.clumped_share; },
            "Share of these gaps that are below 50 µs. null: fewer than two left."),
        base::computed<L>(
            "missing_run_updates",
            [](const L& lens) -> const auto& { return lens.measured.missing_runs; },
            "Runs of numbers that were missing, lost or late, when a later one left; `mean` and "
            "`max` in datagrams."),
        base::computed<L>(
            "reorder_extent",
            [](const L& lens) {
                return ReorderReport{lens.measured.reordered, lens.measured.beyond_look_back};
            },
            "Reordered datagrams, and by how many departures each came after the first with a "
            "higher number."),
        base::computed<L>(
            "age_ms", [](const L& lens) -> const auto& { return lens.measured.age; },
            "Age of information (Kaul, Yates, Gruteser, 2012): how old the newest datagram at the "
            "output is, averaged over time, and just before each newer one leaves, on average and "
            "at most. null: fewer than two left in order."),
        base::member("over_time", &L::over_time,
                     "With --fates, at the end of the run: the run in at most 256 stretches, from "
                     "10 ms long, as a list of [these](#a-stretch-of-a-run).")
            .left_out_if_none());
}

/// The share of the time and the number of stays of one regime.
struct RegimeReport {
    double share = 0.0;
    std::uint64_t stays = 0;
};
constexpr auto fields_of(base::Tag<RegimeReport>)
{
    return base::fields("regime",
                        base::member("share", &RegimeReport::share, "Its share of the time so far.")
                            .gauge("hapnet_emulator_regime_share"),
                        base::member("stays", &RegimeReport::stays, "How often it has begun.")
                            .counter("hapnet_emulator_regime_stays"));
}

/// The reports on the regimes, by their names.
using RegimeReports = base::Entries<RegimeReport>;
/// Returns nullopt if there are no regimes.
[[nodiscard]] std::optional<RegimeReports>
regime_reports_of(const Regimes& regimes, const std::vector<RegimeCourse>& course);

/// The data that a run has about one direction.
struct DirectionReport {
    const Statistics* statistics = nullptr;
    const StreamTotals* stream = nullptr; // nullptr: this is the sum of several paths
    std::uint64_t strangers = 0;
    std::uint64_t overflowed = 0;
    std::uint64_t unreachable = 0;
    base::Duration budget{};
    bool has_distributions = false; // whole distributions as well as quantiles
    std::optional<RegimeReports> regimes{};

    /// Returns the reasons why this direction is not valid; none if it is valid. See
    /// invalid_because().
    [[nodiscard]] std::vector<std::string> reasons() const;

    [[nodiscard]] TimesReport times(const base::DurationHistogram& histogram) const;
    [[nodiscard]] std::optional<StreamShape> lens() const;
};
constexpr auto fields_of(base::Tag<DirectionReport>)
{
    using D = DirectionReport;
    return base::fields(
        "direction",
        base::computed_part<D>([](const D& one) -> const Counters& { return *one.statistics; }),
        base::computed<D>(
            "lateness_us", [](const D& one) { return one.times(one.statistics->lateness); },
            "Time sent minus time due; each is null while nothing has left.")
            .told("lateness of the emulator")
            .gauge("hapnet_emulator_lateness"),
        base::computed<D>(
            "sojourn_us",
            [](const D& one) {
                return TimesReport{&one.statistics->sojourn, std::nullopt};
            },
            "The time in the queue of a `rate`, until its first bit left, of all that the line "
            "sent; each is null without a rate."),
        base::member("strangers", &D::strangers,
                     "Datagrams on this direction's socket from any address but its end's. They "
                     "are not in `received`.")
            .told("from strangers"),
        base::member("overflowed", &D::overflowed,
                     "Messages that the kernel dropped because the relay did not read fast enough. "
                     "They are not in `received` either; a message may be up to 64 datagrams of a "
                     "sender that merges them (UDP_SEGMENT).")
            .told("overflowed"),
        base::member(
            "unreachable", &D::unreachable,
            "Answers that no program listens where `delivered` datagrams went (ICMP, \"port "
            "unreachable\"). Hosts limit how many they send.")
            .told("unreachable")
            .counter("hapnet_emulator_unreachable"),
        base::computed<D>(
            "over_budget", [](const D& one) { return one.statistics->late_beyond(one.budget); },
            "Datagrams that left later than the budget."),
        base::computed<D>(
            "valid", [](const D& one) { return one.reasons().empty(); },
            "Whether this direction is [valid](#what-valid-means)."),
        base::computed<D>(
            "invalid_because", [](const D& one) { return one.reasons(); },
            "The reasons as a list of texts; empty when valid."),
        base::member("regimes", &D::regimes,
                     "With [`[[up.regime]]`](profile.md#regimes): each regime by its name; not of "
                     "the sum of several paths.")
            .label("regime")
            .left_out_if_none(),
        base::computed<D>(
            "lens", [](const D& one) { return one.lens(); },
            "[The shape of the stream](#the-shape-of-a-stream) as a receiving loop gets it. Copies "
            "count nowhere in it.")
            .left_out_if_none());
}

} // namespace hapnet::emulator
