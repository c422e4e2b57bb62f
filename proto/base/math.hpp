// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::base {

inline constexpr double two_pi = 6.283185307179586476925;

// sin, cos, exp and log, computed with + - * / only, so that a stepped loop gives the same bits
// with every compiler and C library. The results are within 2 units in the last place of the true
// value over the stated range. Polynomials and argument reduction follow fdlibm (Sun Microsystems,
// 1993).

/// Returns the sine of `radians` for |radians| <= 1e6; outside this range NaN.
[[nodiscard]] double sin(double radians);

/// Returns the cosine of `radians` for |radians| <= 1e6; outside this range NaN.
[[nodiscard]] double cos(double radians);

/// Replaces each number of turns, |turns| < 1e15, by sin(2 pi turns), to 5e-16. In a batch, each
/// costs a fifth of a call of sin().
void sines_of_turns(std::span<double> turns);

/// Returns e to the power of x for -700 <= x <= 700; beyond this range 0 or infinity.
[[nodiscard]] double exp(double x);

/// Returns the natural logarithm of x. It is -infinity for 0, infinity for infinity, and NaN below
/// 0.
[[nodiscard]] double log(double x);

/// Returns log(1 + x) for x > -1, also where x is too small to change 1 + x. It is -infinity for x
/// = -1, and NaN below. The result is within 4 units in the last place.
[[nodiscard]] double log1p(double x);

} // namespace hapnet::base
