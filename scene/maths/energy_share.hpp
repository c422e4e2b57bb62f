// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

/// The energy that impulses give when all are scaled by one share s: none + linear s + square s^2,
/// J. Kinetic energy is such a parabola, with square >= 0. Without impulses nothing is gained, so
/// there always is a share that gains no more than is allowed.
struct EnergyOfShare {
    double none = 0.0;
    double linear = 0.0;
    double square = 0.0;

    [[nodiscard]] double at(double share) const { return none + share * (linear + share * square); }
    /// Returns the largest share, at most 1, that gains no more than `most`. Where there is none,
    /// returns the share that gains least. Returns 0 if a value is not a number.
    [[nodiscard]] double share_within(double most) const
    {
        if (none + linear + square <= most) return 1.0;
        const double room = most - none;
        const double root = std::sqrt(std::max(linear * linear + 4.0 * square * room, 0.0));
        const double share =
            linear > 0.0 ? 2.0 * room / (linear + root) : (root - linear) / (2.0 * square);
        return share > 0.0 ? std::min(share, 1.0) : 0.0;
    }
    /// Returns the share, at most 1, that gains least.
    [[nodiscard]] double share_of_least() const
    {
        const double share = -linear / (2.0 * square);
        return share > 0.0 ? std::min(share, 1.0) : 0.0;
    }
};

/// The greatest number of rounds of a search in which the allowed gain itself shrinks with the
/// share. Each round stays within the result of the previous one. Searches nearly always end after
/// two or three rounds. Later rounds shrink the share faster than needed, so that every search
/// ends.
inline constexpr int share_rounds_max = 64;
[[nodiscard]] inline double next_share(double share, double within, int round)
{
    constexpr int patient = 8;
    constexpr double faster = 0.9;
    return std::min(share, round < patient ? within : faster * within);
}

} // namespace hapnet::scene
