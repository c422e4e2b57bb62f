// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <cmath>
#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The distribution of values, in their own unit; `std` is the population's standard deviation.
struct Spread {
    double mean = 0.0;
    double min = 0.0;
    double max = 0.0;
    double std = 0.0;

    friend bool operator==(const Spread&, const Spread&) = default;
};

constexpr auto fields_of(base::Tag<Spread>)
{
    return base::fields("spread", base::member("mean", &Spread::mean),
                        base::member("min", &Spread::min), base::member("max", &Spread::max),
                        base::member("std", &Spread::std));
}

/// Converts to another unit.
[[nodiscard]] constexpr Spread operator*(double unit, const Spread& of)
{
    return {unit * of.mean, unit * of.min, unit * of.max, unit * of.std};
}

/// Returns nullopt when there are no values.
[[nodiscard]] std::optional<Spread> spread_of(std::span<const double> values);

} // namespace hapnet::lab::metrics
