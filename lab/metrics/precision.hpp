// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/psychometric.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::lab::metrics {

// The difference of a figure from its value with a finer step or more seeds, and the order in which
// the difference falls.

/// Returns the means of the values of `draws` seeds in each bootstrap replicate. Replicate i draws
/// the same seeds in all calls with equally many seeds.
[[nodiscard]] std::vector<double> mean_replicates(std::span<const double> by_seed,
                                                  std::size_t draws);

/// Returns the root mean square of the values' differences from `truth`; infinite when one of them
/// is. Needs at least one value.
[[nodiscard]] double root_mean_square_error(std::span<const double> values, double truth);

/// Returns a 95 % interval of a paired difference, by replicates that drew the same seeds.
[[nodiscard]] Interval paired_interval(std::span<const double> a, std::span<const double> b,
                                       std::uint32_t seeds);

/// An error at a step. Both are above zero. The step is a time, or 1 / n for n seeds.
struct StepError {
    double step = 0.0;
    double error = 0.0;
};

/// Returns the order p with which errors against a reference fall: |error| = C |step^p -
/// reference^p|, fitted by least squares to the logarithms. `reference` is the step of the
/// reference, or 0 when the errors are against the truth. No step equals `reference`. nullopt with
/// fewer than two different steps, and when no p between 0.1 and 6 fits best.
[[nodiscard]] std::optional<double> order_of(std::span<const StepError> errors,
                                             double reference = 0.0);

} // namespace hapnet::lab::metrics
