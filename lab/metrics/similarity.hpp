// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The similarity of one force to another after compensation of the delay.
struct Similarity {
    double share = 0.0; // 1: identical; can be below 0
    double lag_s = 0.0; // delay that was compensated

    friend bool operator==(const Similarity&, const Similarity&) = default;
};
constexpr auto fields_of(base::Tag<Similarity>)
{
    return base::fields("similarity",
                        base::member("share", &Similarity::share, "1: the same; may be below 0."),
                        base::member("lag_s", &Similarity::lag_s, "The lag that was taken out."));
}

/// Returns the similarity of the force that one hand receives to the force that the other hand
/// sends. It is robust against delay, after the haptic structural similarity (HSSIM) of Sakr,
/// Georganas and Zhao. The received force is shifted back by the lag, 0 to 0.5 s, at which the two
/// correlate best. Forces are compressed to log(1 + |F| / 0.05 N), as sensation is. The structural
/// similarity index is computed in windows of 50 ms, and its mean is returned. nullopt when there
/// is less than 1 s, or no force.
[[nodiscard]] std::optional<Similarity>
similarity_of(std::span<const double> sent, std::span<const double> received, double tick_s);

} // namespace hapnet::lab::metrics
