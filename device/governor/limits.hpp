// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <limits>
#include <optional>
#include <string_view>

namespace hapnet::device {

/// What a hand may be given. The first part is a person's and the program's to say; the second is
/// the device's, and without one there is no limit: limits_for() puts the two together. Where the
/// numbers come from stands in docs/design/governor.md.
struct GovernorLimits {
    double force_max_n = 3.3;         // peak; the Omni's
    double slew_max_n_per_s = 1000.0; // a contact may rise in a few ticks, but not kick
    base::Duration fade_out{std::chrono::milliseconds{50}};
    base::Duration ramp_in{std::chrono::seconds{1}};
    base::Duration tick{std::chrono::milliseconds{1}};       // a late tick grants no larger step
    base::Duration stall_max{std::chrono::milliseconds{20}}; // a longer gap starts from zero
    /// A device or a loop that is silent for longer than stall_max gives zero, for longer than
    /// this a fault.
    base::Duration fault_after{std::chrono::milliseconds{100}};
    double slew_ramping_n_per_s = 100.0; // of a force that grows while it ramps in from zero
    base::Duration heat_time{std::chrono::seconds{15}}; // that motors take to warm up

    // Of the device, in its own frame.
    double force_continuous_n = std::numeric_limits<double>::infinity();
    double speed_max_m_per_s = std::numeric_limits<double>::infinity();
    int axes_out = 3;
    base::Position workspace_min{glm::dvec3{-std::numeric_limits<double>::infinity()}};
    base::Position workspace_max{glm::dvec3{std::numeric_limits<double>::infinity()}};
    std::optional<JointLimits> joints{};
};

/// Why no governor can keep to these, for a person: a rule would never act, or always, or divide by
/// nothing. "" when one can. A peak below the continuous force is no contradiction, but a person
/// who wants it softer than the motors could.
[[nodiscard]] std::string_view contradiction_in(const GovernorLimits& limits);

/// The limits that hold for this device: of each the stricter. A device that does not say what its
/// motors bear for ever is taken to bear a quarter of its peak, as the Omni does (0.88 of 3.3 N).
[[nodiscard]] GovernorLimits limits_for(const Capabilities& capabilities,
                                        const GovernorLimits& limits);

} // namespace hapnet::device
