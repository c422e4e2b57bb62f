// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governor/trip.hpp"

#include <optional>

namespace hapnet::device {

/// Holds a fault until an operator acts: puts the stylus into its holder, where it then rests for
/// 50 ms, or presses the primary button after it was at rest for a second, and holds it for 0.3 s.
/// Never opens by itself, nor by a button that flickers or that was down already, nor while the
/// device is still at fault; but a stylus that was put there meanwhile counts, as for some faults
/// that is the cure.
class FaultLatch {
public:
    [[nodiscard]] bool is_closed() const { return latched_.fault != Fault::none; }
    [[nodiscard]] const Latched& cause() const { return latched_; }

    /// Latches a cause. The first cause stays. Returns true if this is the first.
    bool close(const Latched& cause);
    void open() { latched_ = {}; }

    /// Takes a sample without a fault, `passed` after the one before. Returns true if the operator
    /// has just opened the latch.
    bool on_sample(const Sample& sample, base::Duration passed);
    /// A sample that is at fault or old: what the operator did before counts no more, but that the
    /// stylus was out of its holder.
    void on_bad_sample(const Sample& sample)
    {
        last_.reset();
        was_out_ = was_out_ || !sample.docked;
    }

    /// Slower than this the stylus is at rest: a filtered count of an encoder and a tremor are.
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
