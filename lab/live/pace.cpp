// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/live/pace.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::lab::live {

std::optional<base::Duration> Pace::due(base::Duration passed, base::Duration tick)
{
    if (!plays_) {
        owed_s_ = 0.0;
        return base::Duration{0};
    }
    if (!factor_) return std::nullopt;
    // Time that a suspended program has missed is not played later.
    constexpr base::Duration at_once{std::chrono::milliseconds{100}};
    owed_s_ += base::to_seconds(std::min(passed, at_once)) * *factor_;
    const auto ticks = std::floor(owed_s_ / base::to_seconds(tick));
    owed_s_ -= ticks * base::to_seconds(tick);
    return static_cast<base::Duration::rep>(ticks) * tick;
}

} // namespace hapnet::lab::live
