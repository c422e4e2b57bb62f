// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governed_force.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::device {

/// What a hand may be given. Defaults: the Omni's peak force, and a slew that lets a contact
/// rise in a few ticks but not kick.
struct GovernorLimits {
    double force_max_n = 3.3;
    double slew_max_n_per_s = 1000.0;
    base::Duration fade_out{std::chrono::milliseconds{50}};
    base::Duration ramp_in{std::chrono::seconds{1}};
    base::Duration tick{std::chrono::milliseconds{1}};       // a late tick grants no larger step
    base::Duration stall_max{std::chrono::milliseconds{20}}; // a longer gap starts from zero
};

/// How often each rule had to act.
struct GovernorCounters {
    std::uint64_t not_finite = 0;
    std::uint64_t clamped = 0;
    std::uint64_t slewed = 0;
    std::uint64_t faded = 0;   // ticks at less than full strength
    std::uint64_t stalled = 0; // gaps between ticks that were too long
};

/// What the scene wants of a hand.
struct Wish {
    base::Force force;      // in the device's frame
    bool permitted = false; // there is a session, and its other side is heard
};

/// Stands between what the scene wants and what a motor gets; the only way to a motor.
/// Non-finite becomes zero at once; without permission (no session, stale remote, unusable
/// sample) the force fades to zero, and with it back ramps in again; the norm is clamped with the
/// direction kept; the change per tick is limited; after a stall of the loop the force starts
/// again from zero and ramps in.
class Governor {
public:
    explicit Governor(const GovernorLimits& limits) : limits_{limits} {}

    /// The force to apply now. Call once per tick, with what the device just said; `now` never runs
    /// backwards.
    [[nodiscard]] GovernedForce govern(const Wish& wish, const Sample& sample, base::TimePoint now);

    [[nodiscard]] const GovernorCounters& counters() const { return counters_; }

private:
    [[nodiscard]] base::Force limit(base::Force wanted, bool permitted, base::TimePoint now);

    GovernorLimits limits_;
    GovernorCounters counters_;
    base::Force last_;
    double strength_ = 0.0; // 0: nothing passes, 1: all does
    std::optional<base::TimePoint> last_time_;
};

} // namespace hapnet::device
