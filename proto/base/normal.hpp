// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::base {

// The standard normal distribution, computed with + - * / and sqrt only (see math.hpp), so that it
// gives the same bits with every compiler and C library.

/// Returns P(Z <= z) for -37 <= z <= 8, within a relative 1e-14 of the true value, also in the
/// tails; below about -37 it is 0. Cody, "Rational Chebyshev approximations for the error
/// function", Math. Comp. 23 (1969), in the form of his ANORM, Algorithm 715, ACM TOMS 19 (1993).
[[nodiscard]] double normal_cdf(double z);

/// Returns the z with normal_cdf(z) = probability for 0 < probability < 1, within 2e-15 (relative;
/// absolute if |z| < 1). It is -infinity for 0, infinity for 1, and NaN outside [0, 1]. Wichura,
/// Algorithm AS 241 (PPND16), Applied Statistics 37 (1988).
[[nodiscard]] double normal_quantile(double probability);

} // namespace hapnet::base
