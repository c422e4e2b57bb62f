// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <functional>
#include <span>
#include <vector>

namespace hapnet::emulator::tools {

// Tests of delays. The first two are for independent draws: of correlated ones test the
// innovations, or take some far enough apart.

/// The distribution function of a law: the probability of at most so many nanoseconds.
using Distribution = std::function<double(double)>;

/// Kolmogorov and Smirnov: the largest distance of the two distribution functions. Values are
/// rounded to nanoseconds; a law may have atoms, such as delays that were cut off at zero.
[[nodiscard]] TestResult test_distribution(std::vector<base::Duration> delays,
                                           const Distribution& law, double alpha);

/// Anderson and Darling, which looks at the tails. Not for laws with atoms.
[[nodiscard]] TestResult test_tails(std::vector<base::Duration> delays, const Distribution& law,
                                    double alpha);

/// Whether two sets of delays follow one law, whatever it is (Kolmogorov and Smirnov).
[[nodiscard]] TestResult test_same_law(std::vector<base::Duration> a, std::vector<base::Duration> b,
                                       double alpha);

/// Delays of a law without atoms, made normal: the quantile of the normal law at the probability
/// that the law gives each.
[[nodiscard]] std::vector<double> normal_scores(std::span<const base::Duration> delays,
                                                const Distribution& law);

/// Whether neighbouring scores are correlated as they should be: the innovations
/// (z[i+1] - rho z[i]) / sqrt(1 - rho^2) against z[i]. `rho`: expected, |rho| < 1.
[[nodiscard]] TestResult test_correlation(std::span<const double> scores, double rho, double alpha);

} // namespace hapnet::emulator::tools
