// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::base {

inline constexpr double two_pi = 6.283185307179586476925;

// sin, cos and exp from + - * / alone, so that a stepped loop gives the same bits with every
// compiler and C library. Within 2 units in the last place of the true value over the stated
// range; polynomials and reduction after fdlibm (Sun Microsystems, 1993).

/// Sine of `radians`, |radians| <= 1e6; outside: NaN.
[[nodiscard]] double sin(double radians);

/// Cosine of `radians`, |radians| <= 1e6; outside: NaN.
[[nodiscard]] double cos(double radians);

/// e to the power of x for -700 <= x <= 700; beyond: 0 or infinity.
[[nodiscard]] double exp(double x);

} // namespace hapnet::base
