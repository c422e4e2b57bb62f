// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// The due time of a tick, its delay, and the number of ticks that were skipped before it because
/// it was too late for them.
struct TickTime {
    base::TimePoint due;
    base::Duration late{};
    std::uint32_t missed_before = 0;
};

/// Sets the due times of ticks by the host's clock: at a fixed rate, in absolute time.
class FixedRateTimer {
public:
    /// The first tick is due one period after `now`.
    FixedRateTimer(base::TimePoint now, base::Duration tick) : tick_{tick}, due_{now + tick} {}

    [[nodiscard]] base::TimePoint next() const { return due_; }
    /// Returns the time of a tick that begins at `now`, after next().
    [[nodiscard]] TickTime begin(base::TimePoint now) const { return {due_, now - due_, missed_}; }
    /// Ends a tick at `now`. Skips the ticks whose whole period has passed.
    void end(base::TimePoint now);

private:
    base::Duration tick_;
    base::TimePoint due_;
    std::uint32_t missed_ = 0;
};

/// Sets the due times of ticks by the cycles of a device. If the device is faster than the session,
/// some of its cycles are skipped. Lateness is relative to the device's own rhythm: the due times
/// follow its cycles slowly (by a 32nd of the difference). So the drift of the device's clock does
/// not count as lateness, but jitter does.
class DeviceTimer {
public:
    explicit DeviceTimer(base::Duration tick) : tick_{tick} {}

    /// Returns the time of a tick for a cycle at `now`; nullopt if it is too early for a tick.
    [[nodiscard]] std::optional<TickTime> at(base::TimePoint now);

private:
    base::Duration tick_;
    std::optional<base::TimePoint> due_;
    std::optional<base::TimePoint> last_cycle_;
};

} // namespace hapnet::peer
