// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/loop/watchdog.hpp"

#include <cstdint>

namespace hapnet::peer::loop {

/// A rig for one tick of a watched loop, made before the device is read. A force that it applies
/// never outlasts a halt by the watchdog in the same tick.
class WatchedRig {
public:
    /// Both outlive it.
    WatchedRig(device::Rig& rig, const Watchdog& watchdog)
        : rig_{rig}, watchdog_{watchdog}, halts_before_{watchdog.halts()}
    {}

    [[nodiscard]] const device::Sample& read(base::TimePoint now) { return rig_.read(now); }

    /// As Rig::apply(), but with zero force when the watchdog has halted the device since the tick
    /// began. In a dying program the device is told nothing, and the governor does not go on.
    base::Force apply(const base::Force& wanted, bool permitted, base::TimePoint now)
    {
        if (watchdog_.is_dying()) return {};
        if (watchdog_.halts() != halts_before_) return rig_.withhold(wanted, permitted, now);
        const base::Force force = rig_.apply(wanted, permitted, now);
        // The force may have been on its way to the device when the watchdog halted that.
        if (watchdog_.is_dying() || watchdog_.halts() != halts_before_) rig_.device().halt();
        return force;
    }

    [[nodiscard]] device::GovernorState governor_state() const { return rig_.governor_state(); }
    void on_cue(const device::Cue& cue) { rig_.on_cue(cue); }

private:
    device::Rig& rig_;
    const Watchdog& watchdog_;
    std::uint64_t halts_before_;
};

} // namespace hapnet::peer::loop
