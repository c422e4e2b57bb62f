// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::base {

// The standard normal distribution from + - * / and sqrt alone (see math.hpp), the same bits with
// every compiler and C library.

/// P(Z <= z). Within 1e-14 of the true value, relative, also in the tails, for -37 <= z <= 8; below
/// about -37: 0. Cody, "Rational Chebyshev approximations for the error function", Math. Comp. 23
/// (1969), in the form of his ANORM, Algorithm 715, ACM TOMS 19 (1993).
[[nodiscard]] double normal_cdf(double z);

/// The z with normal_cdf(z) = probability, 0 < probability < 1, within 2e-15 (relative; absolute
/// below 1). -infinity at 0, infinity at 1; outside: NaN. Wichura, Algorithm AS 241 (PPND16),
/// Applied Statistics 37 (1988).
[[nodiscard]] double normal_quantile(double probability);

} // namespace hapnet::base
