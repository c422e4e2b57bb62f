// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/one_way_delay.hpp"

#include "peer/core/sync/situation.hpp"

#include <algorithm>

namespace hapnet::peer {

std::optional<base::Duration> one_way_delay(const ReceivedState& received)
{
    const auto clock = received.clock.estimate();
    if (!clock) return std::nullopt;
    const base::Duration delay = (received.arrived - received.state.sent) + clock->offset;
    if (std::chrono::abs(delay) > believable_delay) return std::nullopt;
    return delay;
}

void OneWayDelay::add(base::Duration delay)
{
    if (count_ == 0) median_ = delay;
    median_ += std::clamp(delay - median_, -step, step);
    if (count_ < memory_) ++count_;
    mean_s_ += (base::to_seconds(delay) - mean_s_) / count_;
}

base::Duration OneWayDelay::mean() const
{
    return std::max(base::Duration{0}, base::from_seconds(mean_s_));
}

base::Duration OneWayDelay::median() const { return std::max(base::Duration{0}, median_); }

} // namespace hapnet::peer
