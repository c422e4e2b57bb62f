// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::lab::metrics {

// The level of an impairment at which a share of the sessions fails: a psychometric function is
// fitted to how many fail at each level (Wichmann and Hill, "The psychometric function: I. Fitting,
// sampling, and goodness of fit", Perception & Psychophysics 63, 2001, 1293-1313),
//
//     psi(x) = early + (1 - early - late) F((x - a) / s),
//
// where `early` is the share that fails however small the impairment is (one unlucky instant of a
// script) and `late` the share that passes however large it is. Both are at most 0.05, in steps of
// 0.025. F is one of two usual cores: the logistic 1 / (1 + exp(-z)), or Gumbel's
// 1 - exp(-exp(z)), which rises slowly and ends steeply, as where the worst instant of a session
// decides. The lapses are those that the outcomes are most likely with, and the core is the
// logistic unless Gumbel's is clearly likelier. a and s are those of greatest posterior
// probability, with one weak prior: log s is normal about the distance of the levels, with a
// standard deviation of 1, so that outcomes which change from all to nothing between two levels
// still have a fit, about half-way between the two (after Kuss, Jaekel and Wichmann, "Bayesian
// inference for psychometric functions", Journal of Vision 5, 2005, 478-492).

/// The outcome of one level: for each seed true if its session failed, in the order of the seeds.
struct LevelOutcome {
    double level = 0.0;
    std::vector<bool> failed;
};

/// The number of sessions at a level, and the number that failed.
struct FailCount {
    double level = 0.0;
    double failed = 0.0;
    double of = 0.0;
};

/// The shape of a curve between its lapses.
enum class Core : std::uint8_t { logistic, gumbel };

/// The fitted curve.
struct Psychometric {
    double location = 0.0; // a in psi(x)
    double scale = 1.0;    // s in psi(x), above 0
    double early = 0.0;
    double late = 0.0;
    Core core = Core::logistic;

    [[nodiscard]] double share_at(double level) const;
    /// The level at which that share fails; early < share < 1 - late.
    [[nodiscard]] double level_of(double share) const;
};

/// Levels ascending, two at least.
[[nodiscard]] Psychometric fitted(std::span<const FailCount> counts);

/// "Not within the levels that were tried."
inline constexpr double beyond = std::numeric_limits<double>::infinity();

inline constexpr std::uint32_t bootstrap_replicates = 1000;

/// The number of times that each seed occurs in each bootstrap replicate, which has `draws` draws,
/// by a generator of its own. Equal arguments give equal draws.
[[nodiscard]] std::vector<std::vector<double>> drawn_weights(std::size_t seeds, std::size_t draws);

/// The level at which half of the sessions fail, and its interval.
struct Threshold {
    double p50 = 0.0; // at most the highest level
    /// The level at which a tenth fails; nullopt: not within the levels.
    std::optional<double> p10{};
    bool is_open = false; // less than half fail at the highest level: p50 is the top of the range
    /// The 95 % interval of p50: interval_of() the replicates. Where the levels stand too far apart
    /// to show the curve near one half - at none of them is the count of failures compatible with
    /// one half by a two-sided sign test at 5 % - it reaches at least from the last level with
    /// fewer to the first with more: without the curve's shape, no more is known.
    double low = 0.0;
    std::optional<double> high{}; // nullopt: above the highest level
    /// p50 of each bootstrap replicate, `beyond` where less than half fail at the highest level.
    /// Replicate i of every threshold of as many seeds draws the same seeds: differences of two
    /// algorithms are paired.
    std::vector<double> replicates{};
    std::uint32_t seeds = 0;
};

/// Levels ascending, as many seeds in each, one of both at least. `top` is the highest level that
/// there may be. Seeds are drawn with replacement, each with its outcomes at all levels (they are
/// not independent), by a generator of its own: equal outcomes, equal bits.
[[nodiscard]] Threshold threshold_of(std::span<const LevelOutcome> outcomes, double top);

/// Returns p50 of each bootstrap replicate, as Threshold::replicates, but of `draws` seeds: the
/// result of an experiment with that number of seeds.
[[nodiscard]] std::vector<double> p50_replicates(std::span<const LevelOutcome> outcomes,
                                                 std::size_t draws);

/// The 95 % interval by bootstrap replicates of a sample of so many seeds: their expanded
/// percentiles (Hesterberg, "What Teachers Should Know About the Bootstrap", The American
/// Statistician 69, 2015, 371-386). A plain 2.5th percentile is too near, as replicates of n seeds
/// spread by sqrt((n - 1) / n) too little and take that spread for known; this one is the share of
/// a normal distribution below -sqrt(n / (n - 1)) t, where t is Student's 97.5th percentile with
/// n - 1 degrees of freedom. Nearest rank; values without NaN, at least one.
struct Interval {
    double low = 0.0;
    double high = 0.0;
};
[[nodiscard]] Interval interval_of(std::vector<double> values, std::uint32_t seeds);

/// The fewest seeds for which interval_of() gives 95 %. With fewer seeds its ends would lie beyond
/// all replicates, and it goes from the least of these to the most.
inline constexpr std::uint32_t interval_seeds_min = 6;

/// A paired difference of p50, and its 95 % interval. Two that are both `beyond` do not differ.
struct Difference {
    double value = 0.0;
    Interval interval{};
};
[[nodiscard]] Difference difference_of(const Threshold& a, const Threshold& b);

} // namespace hapnet::lab::metrics
