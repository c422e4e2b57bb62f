// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governor/trip.hpp"

#include <optional>

namespace hapnet::device {

/// Holds a fault until an operator acts. The operator either puts the stylus into its holder, where
/// it then rests for 50 ms, or presses the primary button after the stylus was at rest for a
/// second, and holds it for 0.3 s. The latch never opens by itself, by a button that flickers or
/// that was down already, or while the device is still at fault. A stylus that was put into its
/// holder during the fault counts, because this is the remedy for some faults.
class FaultLatch {
public:
    [[nodiscard]] bool is_closed() const { return latched_.fault != Fault::none; }
    [[nodiscard]] const Latched& cause() const { return latched_; }

    /// Latches a cause. The first cause stays. Returns true if this is the first.
    bool close(const Latched& cause);
    void open() { latched_ = {}; }

    /// Takes a sample without a fault, `passed` after the previous sample. Returns true if the
    /// operator has just opened the latch.
    bool on_sample(const Sample& sample, base::Duration passed);
    /// Takes a sample that has a fault or is old. Earlier actions of the operator then no longer
    /// count, but it is remembered that the stylus was out of its holder.
    void on_bad_sample(const Sample& sample)
    {
        last_.reset();
        was_out_ = was_out_ || !sample.docked;
    }

    /// Below this speed the stylus is at rest. The filtered speed of one encoder count and that of
    /// a tremor are below it.
    static constexpr double rest_speed_max_m_per_s = 0.05;
    static constexpr base::Duration rest_needed{std::chrono::seconds{1}};
    /// A button that is down for a shorter time was touched by mistake, or has a bad contact.
    static constexpr base::Duration press_needed{std::chrono::milliseconds{300}};
    /// A holder's switch that reports the stylus for a shorter time may only have flickered.
    static constexpr base::Duration dock_needed{std::chrono::milliseconds{50}};

private:
    struct LastSample {
        bool pressed = false;
        bool deliberate = false; // the press began after a second at rest
        base::Duration held{};   // time since the press began
        base::Duration docked{}; // time in the holder without a break
        base::Duration rest{};
    };

    Latched latched_;
    std::optional<LastSample> last_;
    bool was_out_ = false; // the stylus was out of its holder since the fault
};

} // namespace hapnet::device
