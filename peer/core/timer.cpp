// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/timer.hpp"

#include <algorithm>

namespace hapnet::peer {

void FixedRateTimer::end(base::TimePoint now)
{
    due_ += tick_;
    missed_ = 0;
    if (now < due_ + tick_) return;
    const auto behind = (now - due_) / tick_;
    missed_ = static_cast<std::uint32_t>(behind);
    due_ += behind * tick_;
}

std::optional<TickTime> DeviceTimer::at(base::TimePoint now)
{
    if (!due_) due_ = now;
    // The tick begins with the cycle nearest to the due time.
    const base::Duration period = last_cycle_ ? std::min(now - *last_cycle_, tick_) : tick_;
    last_cycle_ = now;
    if (now + period / 2 < *due_) return std::nullopt;
    const auto behind = std::max<base::Duration::rep>(0, (now - *due_) / tick_);
    const base::TimePoint due = *due_ + behind * tick_;
    const base::Duration off = now - due;
    due_ = due + tick_ + off / 32;
    // The due time of an early tick is the time of its cycle, so that due + late is exactly the
    // time of the tick.
    return TickTime{std::min(due, now), std::max(off, base::Duration{0}),
                    static_cast<std::uint32_t>(behind)};
}

} // namespace hapnet::peer
