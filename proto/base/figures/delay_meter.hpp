// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::base {

/// Collects one-way delays (RFC 7679) and their variations, |delay - previously added delay| (RFC
/// 3393). The order of adding is the selection function of RFC 3393: a path adds delays in the
/// order of arrival, a probe in the order of its questions. `Collection` is a DurationSample, or a
/// DurationHistogram, whose add() never allocates.
template <typename Collection>
class DelayMeter {
public:
    /// Adds a delay. `apart` is the arrival time minus the sending time, each on its own clock.
    /// `ahead` is the offset of the arrival's clock from the sender's. Variations ignore `ahead`,
    /// because its estimate changes between arrivals.
    void add(Duration apart, Duration ahead = {})
    {
        delays_.add(apart - ahead);
        if (before_) variations_.add(std::chrono::abs(apart - *before_));
        before_ = apart;
    }

    /// Excludes the variation between the last delay and the next one.
    void pause() { before_.reset(); }

    [[nodiscard]] const Collection& delays() const { return delays_; }
    [[nodiscard]] const Collection& variations() const { return variations_; }

private:
    Collection delays_;
    Collection variations_;
    std::optional<Duration> before_; // `apart` of the last delay
};

} // namespace hapnet::base
