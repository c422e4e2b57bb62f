// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governed_force.hpp"
#include "device/governor/energy.hpp"
#include "device/governor/fault_latch.hpp"
#include "device/governor/limits.hpp"
#include "device/governor/motor_heat.hpp"
#include "device/governor/sample_check.hpp"
#include "device/governor/trip.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::device {

/// How often each rule acted; in ticks, unless stated otherwise.
struct GovernorCounters {
    std::uint64_t not_finite = 0;    // requests that were no numbers
    std::uint64_t clamped = 0;       // to the peak
    std::uint64_t heat_limited = 0;  // to what warm motors bear
    std::uint64_t joint_limited = 0; // to what the joints' motors have
    std::uint64_t flattened = 0;     // to the axes that have motors
    std::uint64_t outside = 0;       // of the workspace, where an outward part was taken away
    std::uint64_t slewed = 0;
    std::uint64_t energy_limited = 0; // to what may go into the hand
    std::uint64_t faded = 0;          // ticks at less than full strength
    std::uint64_t stalled = 0;        // gaps between ticks that were too long
    std::uint64_t silent = 0;         // the device said nothing new for too long
    std::uint64_t docked = 0;
    std::uint64_t uncalibrated = 0;
    std::uint64_t too_fast = 0; // without force: it waits until the stylus is slower
    // Faults that were latched, by what latched them.
    std::uint64_t device_faults = 0;
    std::uint64_t silence_faults = 0;
    std::uint64_t loop_faults = 0;
    std::uint64_t speed_trips = 0;
    std::uint64_t jump_trips = 0;
    std::uint64_t nonsense_trips = 0;
    std::uint64_t frozen_trips = 0;
    std::uint64_t runaway_trips = 0;
    std::uint64_t resets = 0; // faults that an operator ended
};

/// The force that the scene requests for a hand.
struct ForceRequest {
    base::Force force;      // in the device's frame
    bool permitted = false; // there is a session, and its other side is heard
};

/// The state of a governor.
enum class GovernorState : std::uint8_t {
    off,         // no report from the device yet
    calibrating, // positions mean nothing yet
    ready,       // zero force: docked, or nothing is permitted
    ramping,     // at part of its strength: on its way in or out
    active,
    fault, // latched: zero force until an operator has acted
    /// Never of a governor itself: a person has stopped the force, and the loop keeps it from the
    /// device.
    withheld,
};

/// In statistics.
constexpr auto names_of(base::Tag<GovernorState> /*enum*/)
{
    return base::names("off", "calibrating", "ready", "ramping", "active", "fault", "withheld");
}

/// Stands between what the scene wants and what a motor gets; the only way to a motor. Its rules,
/// their numbers and the reasons for them: docs/design/governor.md. In short: zero at once for what
/// is no number, for a stylus that is docked, uncalibrated, silent, too fast or at fault, and after
/// a stall of the loop; without permission the force fades; after any zero it ramps in again; the
/// norm is clamped with the direction kept, to the peak, to what warm motors bear and to what the
/// joints' motors have; the change per tick is limited. What is wrong with the device is latched.
class Governor {
public:
    /// The limits must be valid: see validate().
    explicit Governor(const GovernorLimits& limits);

    /// The force to apply now. Call once per tick, with what the device just said; `now` never runs
    /// backwards.
    [[nodiscard]] GovernedForce govern(const ForceRequest& request, const Sample& sample,
                                       base::TimePoint now);

    /// For another party that found a reason to stop, such as a watchdog: zero from the next tick
    /// on.
    void latch(const Latched& cause);
    /// An operator ends the fault; it comes back if its cause remains.
    void reset();

    [[nodiscard]] GovernorState state() const;
    /// The latched fault; Fault::none in any state but fault.
    [[nodiscard]] const Latched& fault() const { return latch_.cause(); }
    [[nodiscard]] const GovernorCounters& counters() const { return counters_; }
    [[nodiscard]] const GovernorLimits& limits() const { return limits_; }
    /// Of the motors, by the forces until now: above 1 the limit goes down.
    [[nodiscard]] double heat() const { return heat_.heat(); }
    /// The energy into the hand; nullptr where the limits have none for it.
    [[nodiscard]] const EnergyFigures* energy() const
    {
        return energy_ ? &energy_->figures() : nullptr;
    }

private:
    /// The effects of a gap between two ticks.
    struct Step {
        base::Duration gap{};
        double ramp = 0.0;   // of strength
        double fade = 0.0;   // of strength
        double slew_n = 0.0; // of force
        double slew_ramping_n = 0.0;
    };
    [[nodiscard]] Step step_of(base::Duration gap) const;
    [[nodiscard]] base::Duration pass(base::TimePoint now);
    [[nodiscard]] bool may_push(const Sample& sample, base::Duration gap);
    void count(Finding finding);
    void fade(bool permitted);
    [[nodiscard]] base::Force shape(base::Force wanted, const Sample& sample);
    [[nodiscard]] base::Force slew(const base::Force& wanted);
    [[nodiscard]] base::Force within_energy(const base::Force& wanted, const Sample& sample);
    void observe(const Sample& sample, base::Duration gap);
    void to_zero();

    GovernorLimits limits_;
    GovernorCounters counters_;
    MotorHeat heat_;
    std::optional<EnergyGuard> energy_;
    SampleCheck check_;
    FaultLatch latch_;
    Finding finding_ = Finding::unheard; // of the last sample
    Step step_;                          // of the last gap: in a steady loop it stays the same
    base::Force last_;                   // what the next force may differ from by one step only
    base::Force held_;                   // what the device was given last
    double strength_ = 0.0;              // 0: nothing passes, 1: all does
    bool from_zero_ = true;              // it has not been at full strength since it was at zero
    std::optional<base::TimePoint> last_time_;
};

} // namespace hapnet::device
