// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// The one-way delay of a path, from its messages. It varies slowly, so that a single early or late
/// message hardly changes it. All messages count, even those that arrive too late to be used,
/// because it is the delay of the path and not only of the used messages.
class OneWayDelay {
public:
    /// `memory` is the number of messages in the mean, at least 1.
    explicit OneWayDelay(std::uint32_t memory) : memory_{memory} {}

    void add(base::Duration delay);

    /// Returns the arithmetic mean of the first messages, and after that an exponential mean. It is
    /// never negative, and zero while nothing is known.
    [[nodiscard]] base::Duration mean() const;
    /// Returns an estimate of the median, which moves toward it by at most 0.1 ms a message (H.
    /// Robbins, S. Monro: A stochastic approximation method, 1951). Use it as a bound of usual
    /// delays, not as a measurement.
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
