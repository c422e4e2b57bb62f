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

// The level of an impairment at which a share of the sessions fails. A psychometric function is
// fitted to the numbers of failures at the levels (Wichmann and Hill, "The psychometric function:
// I. Fitting, sampling, and goodness of fit", Perception & Psychophysics 63, 2001, 1293-1313),
//
//     psi(x) = early + (1 - early - late) F((x - a) / s),
//
// where `early` is the share that fails however small the impairment is (one unlucky instant of a
// script) and `late` the share that passes however large it is. Both are at most 0.05, in steps of
// 0.025. F is one of two usual cores: the logistic 1 / (1 + exp(-z)), or Gumbel's 1 - exp(-exp(z)).
// Gumbel's rises slowly and ends steeply, as where the worst instant of a session decides. The
// lapses are those with which the outcomes are most likely. The core is the logistic unless
// Gumbel's is clearly likelier. a and s have the greatest posterior probability, with one weak
// prior: log s is normal about the distance of the levels, with a standard deviation of 1. So
// outcomes that change from no failures to all between two levels still have a fit, about half-way
// between the two (after Kuss, Jaekel and Wichmann, "Bayesian inference for psychometric
// functions", Journal of Vision 5, 2005, 478-492).

/// The outcome of one level: for each seed, in the order of the seeds, true if its session failed.
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
    /// Returns the level at which that share fails; early < share < 1 - late.
    [[nodiscard]] double level_of(double share) const;
};

/// Fits a curve. The levels are ascending; there are at least two.
[[nodiscard]] Psychometric fitted(std::span<const FailCount> counts);

/// The value of a level that is not within the tried levels.
inline constexpr double beyond = std::numeric_limits<double>::infinity();

inline constexpr std::uint32_t bootstrap_replicates = 1000;

/// Returns the number of times that each seed occurs in each bootstrap replicate, which has `draws`
/// draws. They come from a generator of its own. Equal arguments give equal draws.
[[nodiscard]] std::vector<std::vector<double>> drawn_weights(std::size_t seeds, std::size_t draws);

/// The level at which half of the sessions fail, and its interval.
struct Threshold {
    double p50 = 0.0; // at most the highest level
    /// The level at which a tenth of the sessions fails; nullopt: not within the levels.
    std::optional<double> p10{};
    bool is_open = false; // less than half fail at the highest level: p50 is the top of the range
    /// The lower end of the 95 % interval of p50: interval_of() the replicates. Levels may be too
    /// far apart to show the curve near one half: at none of them is the count of failures
    /// compatible with one half by a two-sided sign test at 5 %. Then the interval reaches at least
    /// from the last level with fewer failures to the first with more, since no more is known
    /// without the curve's shape.
    double low = 0.0;
    std::optional<double> high{}; // nullopt: above the highest level
    /// The p50 of each bootstrap replicate, `beyond` where less than half fail at the highest
    /// level. Replicate i of every threshold with equally many seeds draws the same seeds, so
    /// differences of two algorithms are paired.
    std::vector<double> replicates{};
    std::uint32_t seeds = 0;
};

/// Finds the threshold. The levels are ascending, each with equally many seeds; there is at least
/// one of both. `top` is the highest level that there may be. Seeds are drawn with replacement,
/// each with its outcomes at all levels (which are not independent), by a generator of its own.
/// Equal outcomes give equal bits.
[[nodiscard]] Threshold threshold_of(std::span<const LevelOutcome> outcomes, double top);

/// Returns the p50 of each bootstrap replicate, as Threshold::replicates, but with `draws` seeds:
/// the result of an experiment with that number of seeds.
[[nodiscard]] std::vector<double> p50_replicates(std::span<const LevelOutcome> outcomes,
                                                 std::size_t draws);

/// A 95 % interval by the bootstrap replicates of a sample of a number n of seeds. Its ends are
/// expanded percentiles (Hesterberg, "What Teachers Should Know About the Bootstrap", The American
/// Statistician 69, 2015, 371-386). A plain 2.5th percentile is too near: replicates of n seeds
/// have a spread that is too small by sqrt((n - 1) / n), and the percentile takes that spread for
/// known. The expanded percentile is the share of a normal distribution below -sqrt(n / (n - 1)) t,
/// where t is Student's 97.5th percentile with n - 1 degrees of freedom. Nearest rank; values
/// without NaN, at least one.
struct Interval {
    double low = 0.0;
    double high = 0.0;
};
[[nodiscard]] Interval interval_of(std::vector<double> values, std::uint32_t seeds);

/// The fewest seeds for which interval_of() gives 95 %. With fewer seeds its ends would lie beyond
/// all replicates, and it goes from the least replicate to the greatest.
inline constexpr std::uint32_t interval_seeds_min = 6;

/// A paired difference of p50, and its 95 % interval. Two values that are both `beyond` do not
/// differ.
struct Difference {
    double value = 0.0;
    Interval interval{};
};
[[nodiscard]] Difference difference_of(const Threshold& a, const Threshold& b);

} // namespace hapnet::lab::metrics
