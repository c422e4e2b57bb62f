// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/tools/learn/measurement.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace hapnet::emulator::tools {

// The likeness of a series to a model that was learned from another series of the same path.

/// Returns both halves of a series, in order. If the number of rows is odd, the first half has one
/// row more.
[[nodiscard]] std::pair<MeasuredWay, MeasuredWay> halves_of(const MeasuredWay& way);

/// Half a 95 % interval of a normal estimate, in standard errors: its 97.5 % quantile.
inline constexpr double standard_errors_95 = 1.959964;

/// Returns the 95 % interval of a share of `count` independent cases (Wilson, Journal of the
/// American Statistical Association 22, 1927).
[[nodiscard]] std::pair<double, double> wilson_interval(double share, double count);

/// Returns the step that all delays of a series are multiples of: 1 ms, 100 us, 10 us or 1 us.
[[nodiscard]] base::Duration resolution_of(const MeasuredWay& way);

/// Returns a simulated measurement of one direction under these conditions: `rows` datagrams at
/// even distances, with delays rounded to `resolution`. `spacing` > 0.
[[nodiscard]] MeasuredWay played(const Conditions& conditions, std::size_t rows,
                                 base::Duration spacing, base::Duration resolution,
                                 base::Seed seed = base::Seed{1});

/// Returns the largest distance of the distribution functions of two series of delays (Kolmogorov
/// and Smirnov), from 0 to 1. Each series has at least one delay.
[[nodiscard]] double distance_between(const MeasuredWay& a, const MeasuredWay& b);

/// Returns the correlation of the delays of datagrams that are `lag` apart, both of which arrived;
/// nullopt: the series is too short, or its spacing is not known. 0 where delays do not vary.
[[nodiscard]] std::optional<double> autocorrelation(const MeasuredWay& way, base::Duration lag);

/// The share of losses right after a delay above the 90th percentile, and the number of such
/// delays.
struct SlowLosses {
    double share = 0.0;
    std::size_t delays = 0;
};
/// Returns nullopt for fewer than 30 losses, or when there is no such delay.
[[nodiscard]] std::optional<SlowLosses> losses_when_slow(const MeasuredWay& way);

/// The correlation of delays at one distance.
struct CorrelationAt {
    base::Duration lag{};
    double first = 0.0;
    double second = 0.0;
    double model = 0.0;
};
constexpr auto fields_of(base::Tag<CorrelationAt>)
{
    using C = CorrelationAt;
    return base::fields("correlation of delays",
                        base::member("lag_s", &C::lag, "How far apart in time."),
                        base::member("first_half", &C::first, "Of the half that was learned."),
                        base::member("second_half", &C::second, "Of the half that was not."),
                        base::member("model", &C::model, "Of what was learned, played."));
}

/// Losses right after delays above the 90th percentile.
struct LossWhenSlow {
    double model = 0.0;
    double low = 0.0;
    double high = 1.0;
};
constexpr auto fields_of(base::Tag<LossWhenSlow>)
{
    using L = LossWhenSlow;
    return base::fields(
        "loss when slow", base::member("model", &L::model, "Share of losses in what was learned."),
        base::member("second_half_low", &L::low,
                     "Lower end of the 95 % interval of the half that was not learned (Wilson)."),
        base::member("second_half_high", &L::high, "Its upper end."));
}

/// The likeness of the second half of a series to a model that was learned from the first half
/// alone.
struct Likeness {
    std::size_t rows = 0;
    double halves_apart = 0.0;
    double model_apart = 0.0;
    std::vector<CorrelationAt> correlations;
    std::optional<LossWhenSlow> loss_when_slow;

    /// False if the halves differ so much that they cannot follow one law.
    [[nodiscard]] bool is_stationary() const { return halves_apart <= 0.1; }
};
constexpr auto fields_of(base::Tag<Likeness>)
{
    using L = Likeness;
    return base::fields(
        "likeness", base::member("rows", &L::rows, "Datagrams in the half that was not learned."),
        base::member("halves_apart", &L::halves_apart,
                     "Largest distance of the distributions of the two halves' delays (Kolmogorov "
                     "and Smirnov): what the best model of the first half would reach."),
        base::member("model_apart", &L::model_apart,
                     "The same of what was learned from the first half and the second half."),
        base::computed<L>(
            "stationary", [](const L& one) { return one.is_stationary(); },
            "Whether the halves are at most 0.1 apart."),
        base::member("correlations", &L::correlations,
                     "Of delays 1, 5 and 15 s apart, as far as the halves reach."),
        base::member("loss_when_slow", &L::loss_when_slow,
                     "Losses right after delays above the 90th percentile. null: a half has fewer "
                     "than 30 losses."));
}

/// Returns the likeness of `second` to `conditions`, which were learned from `first`.
[[nodiscard]] Likeness likeness_of(const Conditions& conditions, const MeasuredWay& first,
                                   const MeasuredWay& second);

/// True if conditions reproduce the delays of the series that they were learned from, well enough
/// for another half of it: distributions at most 0.03 apart, losses right after slow datagrams
/// within their 95 % interval, and each correlation at most 0.1 apart. Regimes last at random, so
/// two series of the same regimes differ by more. Therefore each of these criteria has to be met in
/// one of twenty simulations, not all in the same one. There are 40 simulations of up to 100 000
/// rows, fewer for longer series, and at least 8.
[[nodiscard]] bool is_near(const Conditions& conditions, const MeasuredWay& learned);

} // namespace hapnet::emulator::tools
