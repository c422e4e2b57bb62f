// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/psychometric.hpp"

#include <cstdint>
#include <span>

namespace hapnet::lab::metrics {

/// The comparison of two algorithms that met the same hands and the same network, seed by seed.
struct PairedTest {
    double median = 0.0; // median of the differences a - b
    Interval interval{}; // 95 % interval of the median, by resampling the seeds
    /// Two-sided p of the sign test (Arbuthnott 1710; Conover, "Practical Nonparametric
    /// Statistics", 3.4): the probability of a split of the signs at least as uneven if both signs
    /// were equally likely. Seeds without a difference do not count. 1 when there are no others.
    double p = 1.0;
    std::uint32_t seeds = 0;
    std::uint32_t above = 0; // number of seeds with a > b
    std::uint32_t below = 0;
};

/// Compares the values of a and of b by seed: equally many of both, at least one.
[[nodiscard]] PairedTest paired_test(std::span<const double> a, std::span<const double> b);

/// Returns the median: the middle value, or the mean of the two middle ones. Needs at least one
/// value.
[[nodiscard]] double median_of(std::vector<double> values);

/// Returns the 95 % interval of the mean, by resampling the values. With fewer than
/// interval_seeds_min values, but at least one, returns the least and the greatest value.
[[nodiscard]] Interval interval_of_mean(std::span<const double> values);

/// Returns the value that `share` of the values do not exceed, by the nearest rank. Needs at least
/// one value.
[[nodiscard]] double quantile_of(std::vector<double> values, double share);

/// Returns the 95 % interval of a quantile, from the order of the values alone: the number of
/// values below the true quantile follows a binomial law. An end is infinite where there are too
/// few values.
[[nodiscard]] Interval interval_of_quantile(std::vector<double> values, double share);

/// Returns the two-sided p of the sign test for a split into `above` and `below`: the probability
/// of a split at least as uneven if both signs are equally likely.
[[nodiscard]] double sign_test(std::uint32_t above, std::uint32_t below);

} // namespace hapnet::lab::metrics
