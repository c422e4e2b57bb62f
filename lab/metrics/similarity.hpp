// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The similarity of one force to another once the delay is taken out.
struct Similarity {
    double share = 0.0; // 1: identical; can be below 0
    double lag_s = 0.0; // delay that was taken out

    friend bool operator==(const Similarity&, const Similarity&) = default;
};
constexpr auto fields_of(base::Tag<Similarity>)
{
    return base::fields("similarity",
                        base::member("share", &Similarity::share, "1: the same; may be below 0."),
                        base::member("lag_s", &Similarity::lag_s, "The lag that was taken out."));
}

/// The similarity of the force that one hand receives to the force that the other hand sends,
/// robust against delay, after the haptic structural similarity (HSSIM) of Sakr, Georganas and
/// Zhao: the received force is shifted back by the lag, 0 to 0.5 s, at which the two correlate
/// best; forces are compressed to log(1 + |F| / 0.05 N), as sensation is; the structural similarity
/// index is taken in windows of 50 ms and its mean returned. nullopt when there is less than 1 s,
/// or no force.
[[nodiscard]] std::optional<Similarity>
similarity_of(std::span<const double> sent, std::span<const double> received, double tick_s);

} // namespace hapnet::lab::metrics
