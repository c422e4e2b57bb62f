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
//     psi(x) = early + (1 - early - late) / (1 + exp(-(x - a) / s)),
//
// where `early` is the share that fails however small the impairment is (one unlucky instant of a
// script) and `late` the share that passes however large it is. Both are at most 0.05, in steps of
// 0.025: the pair that the outcomes are most likely with. a and s are those of greatest posterior
// probability, with one weak prior: log s is normal about the distance of the levels, with a
// standard deviation of 1, so that outcomes which change from all to nothing between two levels
// still have a fit, half-way between the two (after Kuss, Jaekel and Wichmann, "Bayesian inference
// for psychometric functions", Journal of Vision 5, 2005, 478-492).

/// What came of one level: of each seed whether its session failed, in the order of the seeds.
struct LevelOutcome {
    double level = 0.0;
    std::vector<bool> failed;
};

/// How many of how many failed at a level.
struct FailCount {
    double level = 0.0;
    double failed = 0.0;
    double of = 0.0;
};

/// The fitted curve.
struct Psychometric {
    double location = 0.0; // a
    double scale = 1.0;    // s, above 0
    double early = 0.0;
    double late = 0.0;

    [[nodiscard]] double share_at(double level) const;
    /// The level at which that share fails; early < share < 1 - late.
    [[nodiscard]] double level_of(double share) const;
};

/// Levels ascending, two at least.
[[nodiscard]] Psychometric fitted(std::span<const FailCount> counts);

/// "Not within the levels that were tried."
inline constexpr double beyond = std::numeric_limits<double>::infinity();

inline constexpr std::uint32_t bootstrap_replicates = 1000;

/// Where half of the sessions fail, and how sure that is.
struct Threshold {
    double p50 = 0.0; // at most the highest level
    /// Where a tenth fails; nullopt: not within the levels.
    std::optional<double> p10{};
    bool is_open = false; // less than half fail at the highest level: p50 is the top of the range
    /// The 95 % interval of p50: the 2.5th and the 97.5th percentile of the replicates. When no
    /// level has both failures and passes, from the last without failures to the first without
    /// passes at least.
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

/// The 2.5th and the 97.5th percentile (nearest rank) of values without NaN; at least one.
struct Interval {
    double low = 0.0;
    double high = 0.0;
};
[[nodiscard]] Interval interval_of(std::vector<double> values);

/// A paired difference of p50, and its 95 % interval. Two that are both `beyond` do not differ.
struct Difference {
    double value = 0.0;
    Interval interval{};
};
[[nodiscard]] Difference difference_of(const Threshold& a, const Threshold& b);

} // namespace hapnet::lab::metrics
