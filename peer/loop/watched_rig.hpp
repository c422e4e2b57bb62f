// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/loop/force_gate.hpp"
#include "peer/loop/watchdog.hpp"

#include <cstdint>

namespace hapnet::peer::loop {

/// A rig for one tick of a watched loop. Construct it before the device is read. A force that it
/// applies never outlasts a halt by the watchdog in the same tick, and no force passes a closed
/// gate.
class WatchedRig {
public:
    /// All arguments must outlive it. Without a gate, no force is withheld.
    WatchedRig(device::Rig& rig, const Watchdog& watchdog, ForceGate* gate = nullptr)
        : rig_{rig}, watchdog_{watchdog}, gate_{gate}, halts_before_{watchdog.halts()}
    {}

    [[nodiscard]] const device::Sample& read(base::TimePoint now)
    {
        const device::Sample& sample = rig_.read(now);
        if (gate_ != nullptr) withheld_ = gate_->look(sample, rig_.governor_state());
        return sample;
    }

    /// Does the same as Rig::apply(), but with zero force if the watchdog has halted the device
    /// since the tick began, or if the gate is closed. While the program is crashing, the device
    /// gets no command, and the governor does not advance.
    base::Force apply(const base::Force& wanted, bool permitted, base::TimePoint now)
    {
        if (watchdog_.is_dying()) return {};
        if (withheld_ != Withheld::no) return rig_.withhold({}, false, now), base::Force{};
        if (watchdog_.halts() != halts_before_) return rig_.withhold(wanted, permitted, now);
        const base::Force force = rig_.apply(wanted, permitted, now);
        // The force may have been on its way to the device when the watchdog halted the device.
        if (watchdog_.is_dying() || watchdog_.halts() != halts_before_) rig_.device().halt();
        return force;
    }

    [[nodiscard]] device::GovernorState governor_state() const
    {
        const auto state = rig_.governor_state();
        const bool is_told = withheld_ != Withheld::no && state != device::GovernorState::fault;
        return is_told ? device::GovernorState::withheld : state;
    }
    void on_cue(const device::Cue& cue) { rig_.on_cue(cue); }

    /// Returns the reason why force is withheld in this tick.
    [[nodiscard]] Withheld withheld() const { return withheld_; }

private:
    device::Rig& rig_;
    const Watchdog& watchdog_;
    ForceGate* gate_;
    std::uint64_t halts_before_;
    Withheld withheld_ = Withheld::no;
};

} // namespace hapnet::peer::loop
