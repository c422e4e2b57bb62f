// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/governor/energy.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <limits>
#include <optional>

namespace hapnet::device {

/// The limits of the force on a hand. A person and the program choose the first part of them. The
/// device determines the second part; without a device these limits are infinite. limits_for()
/// combines both. docs/design/governor.md gives the sources of the numbers.
struct GovernorLimits {
    double force_max_n = 3.3;         // peak; default: the Omni's
    double slew_max_n_per_s = 1000.0; // a contact may rise in a few ticks, but not kick
    base::Duration fade_out{std::chrono::milliseconds{50}};
    base::Duration ramp_in{std::chrono::seconds{1}};
    base::Duration tick{std::chrono::milliseconds{1}};       // a late tick grants no larger step
    base::Duration stall_max{std::chrono::milliseconds{20}}; // longer gaps restart from zero
    /// If a device or a loop is silent for longer than stall_max, the force is zero. If it is
    /// silent for longer than fault_after, that is a fault.
    base::Duration fault_after{std::chrono::milliseconds{100}};
    double slew_ramping_n_per_s = 100.0; // limit for a growing force during the ramp from zero
    base::Duration heat_time{std::chrono::seconds{15}}; // time constant of the motors' heat
    double heat_start = 0.0; // heat of the motors when the program starts
    /// True to compare motion and force: an encoder that does not change, or motors that push in
    /// the wrong direction, are then faults. For real devices only; simulated and replayed hands
    /// are consistent.
    bool checks_motion = false;

    // Limits of the device, in its own frame.
    double force_continuous_n = std::numeric_limits<double>::infinity();
    double speed_max_m_per_s = std::numeric_limits<double>::infinity();
    int axes_out = 3;
    base::Position workspace_min{glm::dvec3{-std::numeric_limits<double>::infinity()}};
    base::Position workspace_max{glm::dvec3{std::numeric_limits<double>::infinity()}};
    std::optional<JointLimits> joints{};

    /// Limits of the energy that the other side gives to a hand. nullopt: the energy is neither
    /// observed nor limited.
    std::optional<EnergyLimits> energy{};
};

/// Describes the fields of the first part. Outside these ranges a rule would never act, always act,
/// or do harm: a slow slew, for example, keeps a force that should end. Zero force is possible.
constexpr auto fields_of(base::Tag<GovernorLimits> /*struct*/)
{
    using namespace std::chrono_literals;
    return base::fields(
        "governor",
        base::field("force_max", &GovernorLimits::force_max_n,
                    base::Quantity{base::force_kind, 0.0, 40.0}, "peak of the force, by its norm"),
        base::field("slew_max", &GovernorLimits::slew_max_n_per_s,
                    base::Quantity{base::force_rate_kind, 100.0, 40'000.0}, // 40 N in 1 ms
                    "greatest change of the force"),
        base::field("slew_ramping", &GovernorLimits::slew_ramping_n_per_s,
                    base::Quantity{base::force_rate_kind, 1.0, 40'000.0},
                    "greatest growth of the force while it ramps in from zero"),
        base::field("fade_out", &GovernorLimits::fade_out, base::Time{1ms, 1s},
                    "time from full strength to zero once the permission ends"),
        base::field("ramp_in", &GovernorLimits::ramp_in, base::Time{100ms, 1min},
                    "time from zero to full strength"),
        base::field("tick", &GovernorLimits::tick, base::Time{100us, 10ms},
                    "of the loop; a late tick grants no larger step"),
        base::field("stall_max", &GovernorLimits::stall_max, base::Time{2ms, 100ms},
                    "longest gap of the loop or of the device's samples; after a longer one the "
                    "force starts from zero"),
        base::field("fault_after", &GovernorLimits::fault_after, base::Time{2ms, 1s},
                    "silence of the loop or of the device that is a fault"),
        base::field("heat_time", &GovernorLimits::heat_time, base::Time{1s, 10min},
                    "time constant of the motors' heat"),
        base::field("heat_start", &GovernorLimits::heat_start, base::Number{0.0, 100.0},
                    "heat of the motors at the start"),
        base::field("checks_motion", &GovernorLimits::checks_motion,
                    "motion that does not fit the force is a fault"),
        base::field("energy", &GovernorLimits::energy,
                    "energy into the hand; without it that is neither observed nor limited"));
}

/// Returns an error when no governor can keep to these limits: a rule would never act, or always
/// act, or divide by zero. A peak below the continuous force is valid: a person may want a softer
/// force than the motors can give.
[[nodiscard]] base::Result<void> validate(const GovernorLimits& limits);

/// Returns the limits for this device: the stricter one of each pair. A device that does not state
/// its continuous force is assumed to bear a quarter of its peak, as the Omni does (0.88 of 3.3 N).
[[nodiscard]] GovernorLimits limits_for(const Capabilities& capabilities,
                                        const GovernorLimits& limits);

} // namespace hapnet::device
