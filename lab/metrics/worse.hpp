// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/high_pass.hpp"
#include "lab/metrics/spread.hpp"
#include "lab/metrics/steps.hpp"

#include <cmath>
#include <optional>

namespace hapnet::lab::metrics {

// These functions return the larger of two values of one metric, which is the worse one. A number
// that is not finite is worse than any other, so that it fails when it is judged.

[[nodiscard]] inline double larger(double a, double b) { return a > b || std::isnan(a) ? a : b; }

[[nodiscard]] inline ByOrder larger(const ByOrder& a, const ByOrder& b)
{
    return {.first = larger(a.first, b.first),
            .second = larger(a.second, b.second),
            .fourth = larger(a.fourth, b.fourth)};
}

[[nodiscard]] inline ForceSteps larger(const ForceSteps& a, const ForceSteps& b)
{
    return {.largest_n = larger(a.largest_n, b.largest_n),
            .reversals = larger(a.reversals, b.reversals)};
}

/// Returns the spread with the larger mean.
[[nodiscard]] inline Spread larger(const Spread& a, const Spread& b)
{
    return a.mean > b.mean || std::isnan(a.mean) ? a : b;
}

/// Returns the larger value, or the only one that exists.
template <typename Value>
[[nodiscard]] std::optional<Value> worse(const std::optional<Value>& a,
                                         const std::optional<Value>& b)
{
    if (!a || !b) return a ? a : b;
    return larger(*a, *b);
}

} // namespace hapnet::lab::metrics
