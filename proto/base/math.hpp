// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::base {

inline constexpr double two_pi = 6.283185307179586476925;

// sin, cos, exp and log from + - * / alone, so that a stepped loop gives the same bits with every
// compiler and C library. Within 2 units in the last place of the true value over the stated
// range; polynomials and reduction after fdlibm (Sun Microsystems, 1993).

/// Sine of `radians`, |radians| <= 1e6; outside: NaN.
[[nodiscard]] double sin(double radians);

/// Cosine of `radians`, |radians| <= 1e6; outside: NaN.
[[nodiscard]] double cos(double radians);

/// Replaces each number of turns, |turns| < 1e15, by its sine: sin(2 pi turns), to 5e-16. Several
/// at once cost a fifth of sin() each.
void sines_of_turns(std::span<double> turns);

/// e to the power of x for -700 <= x <= 700; beyond: 0 or infinity.
[[nodiscard]] double exp(double x);

/// The natural logarithm of x > 0. The logarithm of 0 is -infinity, that of infinity is infinity;
/// below 0: NaN.
[[nodiscard]] double log(double x);

/// log(1 + x) for x > -1, also where x is too small to show in 1 + x. -infinity at x = -1; below:
/// NaN. Within 4 units in the last place.
[[nodiscard]] double log1p(double x);

} // namespace hapnet::base
