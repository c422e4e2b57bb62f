// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/operator.hpp"
#include "proto/base/random.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hapnet::device {

/// The involuntary part of a hand: wander and tremor along x, and an error of its force. They are
/// sums of sines whose frequencies and phases come from the seed, so that they are pure functions
/// of time.
class HandNoise {
public:
    HandNoise(base::Seed seed, std::uint16_t peer_id, const Operator& person);

    struct Value {
        double away_m = 0.0;      // distance from the intended position
        double force_share = 0.0; // error of the force, as a share of it
    };
    /// Returns the value at `seconds` after the start.
    [[nodiscard]] Value at(double seconds) const;

private:
    static constexpr std::size_t swings_each = 3;
    static constexpr std::size_t swings = 3 * swings_each; // sines for wander, tremor and force

    std::array<double, swings> hertz_{};
    std::array<double, swings> turn_{}; // phases at the start, in turns
    double wander_m_;                   // amplitude of each sine
    double tremor_m_;
    double force_share_;
};

} // namespace hapnet::device
