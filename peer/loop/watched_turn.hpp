// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/loop/watchdog.hpp"

#include <cstdint>

namespace hapnet::peer {

/// A turn of a watched loop, from before the device is read. What it tells the device never lasts
/// longer than what the watchdog has told it meanwhile.
class WatchedTurn {
public:
    /// Both outlive it.
    WatchedTurn(device::Rig& rig, const Watchdog& watchdog)
        : rig_{rig}, watchdog_{watchdog}, halts_before_{watchdog.halts()}
    {}

    /// As Rig::apply(), at zero where the watchdog has let go of the device since the turn began.
    /// In a dying program the device is told nothing, and the governor does not go on.
    base::Force apply(const base::Force& wanted, bool permitted, base::TimePoint now)
    {
        if (watchdog_.is_dying()) return {};
        if (watchdog_.halts() != halts_before_) return rig_.withhold(wanted, permitted, now);
        const base::Force force = rig_.apply(wanted, permitted, now);
        // The force may have been on its way to the device when that was let go of.
        if (watchdog_.is_dying() || watchdog_.halts() != halts_before_) rig_.device().halt();
        return force;
    }

private:
    device::Rig& rig_;
    const Watchdog& watchdog_;
    std::uint64_t halts_before_;
};

} // namespace hapnet::peer
