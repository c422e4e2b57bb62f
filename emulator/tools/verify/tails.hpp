// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::emulator::tools {

// How probable a deviation at least as large is, when the law holds.

/// Of z from 0, either side, for a standard normal variable.
[[nodiscard]] double normal_two_sided(double z);

/// Of so many successes or a rarer side, doubled, at most 1; exact. 0 <= share <= 1.
[[nodiscard]] double binomial_two_sided(std::uint64_t successes, std::uint64_t trials,
                                        double share);

/// Of x or more; degrees > 0.
[[nodiscard]] double chi_square_tail(double x, double degrees);

/// Of a largest distance of `distance` between the distribution of n samples and the true one, by
/// Kolmogorov's limit with Stephens' correction for finite n.
[[nodiscard]] double kolmogorov_tail(double distance, double n);

/// The quantile of the standard normal law, 0 < u < 1.
[[nodiscard]] double normal_score(double u);

} // namespace hapnet::emulator::tools
