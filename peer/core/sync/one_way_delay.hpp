// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// The one-way delay of a path as its messages tell it: slowly varying, so that a single early or
/// late message moves it little. All messages count, also those that came too late to be used: it
/// is the path's delay and not that of the survivors.
class OneWayDelay {
public:
    /// `memory`: number of messages in the mean, at least 1.
    explicit OneWayDelay(std::uint32_t memory) : memory_{memory} {}

    void add(base::Duration delay);

    /// The arithmetic mean of the first messages, then an exponential mean. It is never negative,
    /// and zero while nothing is known.
    [[nodiscard]] base::Duration mean() const;
    /// Moves by at most 0.1 ms a message toward the median (H. Robbins, S. Monro: A stochastic
    /// approximation method, 1951): a bound of what is usual, not a measurement.
    [[nodiscard]] base::Duration median() const;

    void reset() { *this = OneWayDelay{memory_}; }

private:
    static constexpr base::Duration step{std::chrono::microseconds{100}};

    std::uint32_t memory_;
    std::uint32_t count_ = 0; // number of delays in the mean, up to memory_
    double mean_s_ = 0.0;
    base::Duration median_{};
};

} // namespace hapnet::peer
