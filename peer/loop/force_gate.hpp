// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor.hpp"
#include "peer/loop/dead_man.hpp"
#include "proto/net/stop_signal.hpp"

#include <atomic>
#include <cstdint>
#include <utility>

namespace hapnet::peer::loop {

/// The reason why the hand gets no force, whatever session and scene compute.
enum class Withheld : std::uint8_t {
    no,
    by_stop,           // the program is about to end
    by_emergency_stop, // for the rest of the program's life
    by_dead_man,       // the dead man's switch is not held
};

/// A gate between the governor and the motors. It never adds force; it closes when a person or a
/// signal has stopped the force. The loop checks it once per tick, so that a stop does not wait for
/// any other thread.
class ForceGate {
public:
    /// `stop` must outlive it.
    explicit ForceGate(const net::StopSignal& stop, DeadMan dead_man = {})
        : stop_{stop}, dead_man_{std::move(dead_man)}
    {}

    /// Stops all force, until the program is started again. Call it from any thread.
    void stop_in_emergency() { emergency_.store(true, std::memory_order_release); }
    /// True after stop_in_emergency(). Call it from any thread.
    [[nodiscard]] bool is_stopped_in_emergency() const
    {
        return emergency_.load(std::memory_order_acquire);
    }
    [[nodiscard]] bool is_stopping() const { return stop_.requested(); }
    [[nodiscard]] bool has_dead_man() const { return dead_man_.is_asked_for(); }

    /// Returns the reason to withhold force, if any. The loop calls it once per tick, with the
    /// newest sample of the device and the governor's state after the previous tick.
    [[nodiscard]] Withheld look(const device::Sample& sample, device::GovernorState governor)
    {
        const bool is_held = dead_man_.is_held(sample); // in every tick: it reads its input
        if (is_stopping()) return Withheld::by_stop;
        if (is_stopped_in_emergency()) return Withheld::by_emergency_stop;
        // After the switch was released briefly, the force must not jump. It returns only when the
        // governor has also faded out, and then ramps the force in.
        const bool still_fades =
            governor == device::GovernorState::ramping || governor == device::GovernorState::active;
        was_released_ = !is_held || (was_released_ && still_fades);
        return was_released_ ? Withheld::by_dead_man : Withheld::no;
    }

private:
    const net::StopSignal& stop_;
    DeadMan dead_man_;
    bool was_released_ = false;
    std::atomic<bool> emergency_{false};
};

} // namespace hapnet::peer::loop
