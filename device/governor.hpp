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
#include "proto/base/describe.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::device {

/// The number of latched faults, by the rule that latched them; see Trip.
struct FaultCounts {
    std::uint64_t device = 0;
    std::uint64_t silence = 0;
    std::uint64_t loop = 0;
    std::uint64_t speed = 0;
    std::uint64_t jump = 0;
    std::uint64_t nonsense = 0;
    std::uint64_t frozen = 0;
    std::uint64_t runaway = 0;

    [[nodiscard]] std::uint64_t total() const
    {
        return device + silence + loop + speed + jump + nonsense + frozen + runaway;
    }
};
constexpr auto fields_of(base::Tag<FaultCounts>)
{
    using F = FaultCounts;
    return base::fields(
        "faults", base::member("device", &F::device, "The device reported a fault."),
        base::member("silence", &F::silence, "It said nothing new for too long."),
        base::member("loop", &F::loop, "The loop stood still for too long."),
        base::member("speed", &F::speed, "It moved faster than a hand that holds it."),
        base::member("jump", &F::jump, "It was suddenly elsewhere."),
        base::member("nonsense", &F::nonsense, "A place or a velocity was no number."),
        base::member("frozen", &F::frozen, "Its place stayed the same, whatever pushed it."),
        base::member("runaway", &F::runaway, "It sped up against the force."));
}

/// The number of times that each rule acted; in ticks, unless stated otherwise.
struct GovernorCounters {
    std::uint64_t not_finite = 0;
    std::uint64_t clamped = 0;
    std::uint64_t heat_limited = 0;
    std::uint64_t joint_limited = 0;
    std::uint64_t flattened = 0;
    std::uint64_t outside = 0;
    std::uint64_t slewed = 0;
    std::uint64_t energy_limited = 0; // forces reduced by the limits of the energy
    std::uint64_t faded = 0;
    std::uint64_t stalled = 0;
    std::uint64_t silent = 0;
    std::uint64_t docked = 0;
    std::uint64_t uncalibrated = 0;
    std::uint64_t too_fast = 0;
    FaultCounts faults;
    std::uint64_t resets = 0;
};
/// Describes the fields except the energy, which is reported with its limits.
constexpr auto fields_of(base::Tag<GovernorCounters>)
{
    using C = GovernorCounters;
    return base::fields(
        "governor counters",
        base::member("not_finite", &C::not_finite, "Ticks with a requested force of no numbers."),
        base::member("clamped", &C::clamped, "Ticks with a force shortened to the peak."),
        base::member("heat_limited", &C::heat_limited, "To what warm motors bear."),
        base::member("joint_limited", &C::joint_limited, "To what the motors of the joints have."),
        base::member("flattened", &C::flattened, "To the axes that have motors."),
        base::member("outside", &C::outside,
                     "Ticks outside the workspace in which an outward part was taken away."),
        base::member("slewed", &C::slewed, "Ticks in which the change of the force was limited."),
        base::member("faded", &C::faded, "Ticks at less than full strength."),
        base::member("stalled", &C::stalled, "Gaps between ticks that were too long."),
        base::member("silent", &C::silent, "Ticks in which the device had been silent too long."),
        base::member("docked", &C::docked, "Ticks with the stylus in its holder."),
        base::member("uncalibrated", &C::uncalibrated, "Ticks without a calibration."),
        base::member("too_fast", &C::too_fast,
                     "Ticks without force in which the stylus was faster than a hand."),
        base::member("faults", &C::faults, "Faults that were latched, by what latched them."),
        base::member("resets", &C::resets, "Faults that an operator ended."));
}

/// The force that the scene requests for a hand.
struct ForceRequest {
    base::Force force;      // in the device's frame
    bool permitted = false; // there is a session, and data from its other side arrives
};

/// The state of a governor.
enum class GovernorState : std::uint8_t {
    off,         // no report from the device yet
    calibrating, // positions are not valid yet
    ready,       // zero force: the stylus is docked, or no force is permitted
    ramping,     // part of the force: it fades in or out
    active,
    fault, // latched: zero force until an operator has acted
    /// A governor itself never has this state. A person has stopped the force, and the loop keeps
    /// the force from the device.
    withheld,
};

/// The names of states in statistics.
constexpr auto names_of(base::Tag<GovernorState> /*enum*/)
{
    return base::names("off", "calibrating", "ready", "ramping", "active", "fault", "withheld");
}

/// Limits the force that the scene requests before it reaches a motor. Every force passes through a
/// Governor. docs/design/governor.md describes its rules, their numbers and the reasons for them.
/// In short: the force is zero at once if it is not a number, if the stylus is docked,
/// uncalibrated, silent, too fast or at fault, and after a stall of the loop. Without permission
/// the force fades out. After any zero force it ramps up again. The norm is clamped without
/// changing the direction, to the peak, to the limit of warm motors and to the limits of the
/// joints' motors. The change per tick is limited. Faults of the device are latched.
class Governor {
public:
    /// The limits must be valid: see validate().
    explicit Governor(const GovernorLimits& limits);

    /// Returns the force to apply now. Call it once per tick, with the newest sample of the device;
    /// `now` never runs backwards.
    [[nodiscard]] GovernedForce govern(const ForceRequest& request, const Sample& sample,
                                       base::TimePoint now);

    /// Latches a fault that another component, such as a watchdog, has found. The force is zero
    /// from the next tick on.
    void latch(const Latched& cause);
    /// Ends the fault, on the request of an operator. The fault is latched again if its cause
    /// remains.
    void reset();

    [[nodiscard]] GovernorState state() const;
    /// Returns the latched fault. It is Fault::none in any state but fault.
    [[nodiscard]] const Latched& fault() const { return latch_.cause(); }
    [[nodiscard]] const GovernorCounters& counters() const { return counters_; }
    [[nodiscard]] const GovernorLimits& limits() const { return limits_; }
    /// Returns the heat of the motors due to the forces so far, as a share of the limit. Above 1
    /// the force limit decreases.
    [[nodiscard]] double heat() const { return heat_.heat(); }
    /// Returns the energy into the hand; nullptr if the limits have none for it.
    [[nodiscard]] const EnergyFigures* energy() const
    {
        return energy_ ? &energy_->figures() : nullptr;
    }

private:
    /// The effects of a gap between two ticks.
    struct Step {
        base::Duration gap{};
        double ramp = 0.0;   // change of the strength
        double fade = 0.0;   // change of the strength
        double slew_n = 0.0; // largest change of the force
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
    Finding finding_ = Finding::unheard; // result for the last sample
    Step step_;                          // step of the last gap; constant in a steady loop
    base::Force last_;                   // force from which the slew limit of the next tick starts
    base::Force held_;                   // force last given to the device
    double strength_ = 0.0;              // share of the force that passes, 0 to 1
    bool from_zero_ = true;              // not yet at full strength since the last zero
    std::optional<base::TimePoint> last_time_;
};

} // namespace hapnet::device
