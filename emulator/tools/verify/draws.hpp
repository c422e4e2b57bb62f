// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <span>
#include <vector>

namespace hapnet::emulator::tools {

// Tests of delays.

/// Tests if two sets of independent delays follow one law, whatever it is (Kolmogorov and Smirnov).
/// When delays are correlated, pass only those that are far enough apart.
[[nodiscard]] TestResult test_same_law(std::vector<base::Duration> a, std::vector<base::Duration> b,
                                       double alpha);

/// Returns the normal quantile of each delay's rank. Equal delays share a rank.
[[nodiscard]] std::vector<double> rank_scores(const std::vector<base::Duration>& delays);

/// Tests if neighbouring normal scores have the expected correlation, by the innovations (z[i+1] -
/// rho z[i]) / sqrt(1 - rho^2) against z[i]. `rho`: expected, |rho| < 1.
[[nodiscard]] TestResult test_correlation(std::span<const double> scores, double rho, double alpha);

} // namespace hapnet::emulator::tools
