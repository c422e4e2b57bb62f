// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::emulator::tools {

// Probabilities of a deviation at least as large as the observed one, if the law is right.

/// Returns the probability of a distance of at least |z| from 0, on either side, for a standard
/// normal variable.
[[nodiscard]] double normal_two_sided(double z);

/// Returns the exact probability of this number of successes or a rarer one on the same side,
/// doubled, at most 1. 0 <= share <= 1.
[[nodiscard]] double binomial_two_sided(std::uint64_t successes, std::uint64_t trials,
                                        double share);

/// Returns the probability of x or more; degrees > 0.
[[nodiscard]] double chi_square_tail(double x, double degrees);

/// Returns the probability that the distribution of n samples is at least `distance` from the true
/// one, by Kolmogorov's limit with Stephens' correction for finite n.
[[nodiscard]] double kolmogorov_tail(double distance, double n);

/// Returns the quantile of the standard normal law, 0 < u < 1.
[[nodiscard]] double normal_score(double u);

} // namespace hapnet::emulator::tools
