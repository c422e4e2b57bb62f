// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// The due time of a tick, how much later it began, and how many ticks were skipped before it
/// because it was too late for them.
struct TickTime {
    base::TimePoint due;
    base::Duration late{};
    std::uint32_t missed_before = 0;
};

/// Sets the due times of ticks at the host's own pace: at a fixed rate, by absolute time.
class FixedRateTimer {
public:
    /// The first tick is due one period after `now`.
    FixedRateTimer(base::TimePoint now, base::Duration tick) : tick_{tick}, due_{now + tick} {}

    [[nodiscard]] base::TimePoint next() const { return due_; }
    /// A tick that begins at `now`, after next().
    [[nodiscard]] TickTime begin(base::TimePoint now) const { return {due_, now - due_, missed_}; }
    /// Ends a tick at `now`: ticks whose whole period has passed by then are skipped.
    void end(base::TimePoint now);

private:
    base::Duration tick_;
    base::TimePoint due_;
    std::uint32_t missed_ = 0;
};

/// Sets the due times of ticks at the pace of a device: at its cycles. A device that is faster than
/// the session has some of its cycles skipped. Lateness is measured against the device's own
/// rhythm: the due times follow its cycles slowly (by a 32nd of the difference), so that the drift
/// of another clock does not count as lateness, and jitter does.
class DeviceTimer {
public:
    explicit DeviceTimer(base::Duration tick) : tick_{tick} {}

    /// A cycle at `now`; nullopt when it is too early for a tick.
    [[nodiscard]] std::optional<TickTime> at(base::TimePoint now);

private:
    base::Duration tick_;
    std::optional<base::TimePoint> due_;
    std::optional<base::TimePoint> last_cycle_;
};

} // namespace hapnet::peer
