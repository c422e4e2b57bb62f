// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/psychometric.hpp"

#include <cstdint>
#include <span>

namespace hapnet::lab::metrics {

/// Two algorithms that met the same hands and the same network, seed by seed.
struct PairedTest {
    double median = 0.0; // median of the differences a - b
    Interval interval{}; // 95 % interval of the median, by resampling the seeds
    /// Two-sided p of the sign test (Arbuthnott 1710; Conover, "Practical Nonparametric
    /// Statistics", 3.4): the probability of so uneven a split of the signs if each were as likely.
    /// Seeds without a difference do not count; 1 when there are no others.
    double p = 1.0;
    std::uint32_t seeds = 0;
    std::uint32_t above = 0; // number of seeds with a > b
    std::uint32_t below = 0;
};

/// The values of a and of b by seed; as many of both, one at least.
[[nodiscard]] PairedTest paired_test(std::span<const double> a, std::span<const double> b);

/// The mean of the two middle values; at least one.
[[nodiscard]] double median_of(std::vector<double> values);

/// The 95 % interval of the mean, by resampling the values; of fewer than interval_seeds_min, but
/// at least one, the least and the most of them.
[[nodiscard]] Interval interval_of_mean(std::span<const double> values);

/// The value that `share` of the values do not exceed, by the nearest rank; at least one.
[[nodiscard]] double quantile_of(std::vector<double> values, double share);

/// The 95 % interval of a quantile, from the order of the values alone: how many of them lie below
/// the true one follows a binomial law. An end is infinite where there are too few values.
[[nodiscard]] Interval interval_of_quantile(std::vector<double> values, double share);

/// The two-sided p of the sign test for a split into `above` and `below`: the probability of a
/// split at least as uneven if both signs are equally likely.
[[nodiscard]] double sign_test(std::uint32_t above, std::uint32_t below);

} // namespace hapnet::lab::metrics
