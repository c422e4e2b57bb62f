// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::base {

/// Collects one-way delays (RFC 7679) and their variations, |delay - delay added before| (RFC
/// 3393). The order of adding is its selection function: a path is measured in the order of
/// arrival, a probe in the order of its questions. `Collection` is a DurationSample, or a
/// DurationHistogram, whose adding never allocates.
template <typename Collection>
class DelayMeter {
public:
    /// `apart`: the arrival minus the sending, each on its own clock; `ahead`: how far the clock of
    /// the arrival is ahead. It is left out of variations: estimates of it differ between arrivals.
    void add(Duration apart, Duration ahead = {})
    {
        delays_.add(apart - ahead);
        if (before_) variations_.add(std::chrono::abs(apart - *before_));
        before_ = apart;
    }

    /// The next delay is not compared with the one before.
    void pause() { before_.reset(); }

    [[nodiscard]] const Collection& delays() const { return delays_; }
    [[nodiscard]] const Collection& variations() const { return variations_; }

private:
    Collection delays_;
    Collection variations_;
    std::optional<Duration> before_; // `apart` of the last delay
};

} // namespace hapnet::base
