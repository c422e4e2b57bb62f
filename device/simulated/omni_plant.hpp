// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/space.hpp"

#include <optional>

namespace hapnet::device {

/// The figures of a simulated device, per Cartesian axis. The defaults are those of a PHANToM
/// Omni's data sheet.
struct OmniPlant {
    double force_max_n = 3.3;
    double force_continuous_n = 0.88;
    double friction_n = 0.26;       // back-drive, Coulomb
    double resolution_m = 0.000055; // nominal position resolution
    glm::dvec3 half_workspace_m{0.080, 0.060, 0.035};
    double velocity_cutoff_hz = 30.0; // cutoff of the filter on differenced positions
    /// The cutoff of the first-order low-pass between the force that is asked for and the force at
    /// the grip; nullopt: they are equal.
    std::optional<double> force_bandwidth_hz{};
    /// The friction that the device states, which the other peers' models use; nullopt: its own.
    std::optional<double> stated_friction_n{};

    friend bool operator==(const OmniPlant&, const OmniPlant&) = default;
};
constexpr auto fields_of(base::Tag<OmniPlant> /*struct*/)
{
    using Plant = OmniPlant;
    constexpr base::Quantity friction{base::force_kind, 0.0, 3.0};
    return base::fields(
        "device",
        base::field("friction", &Plant::friction_n, friction, "back-drive friction of the grip"),
        base::field("resolution", &Plant::resolution_m,
                    base::Quantity{base::length_kind, 1e-7, 0.01}, "the step of its positions"),
        base::field("force_bandwidth", &Plant::force_bandwidth_hz,
                    base::Quantity{base::frequency_kind, 1.0, 1e4},
                    "cutoff of the low-pass between the force that is asked for and the grip; "
                    "without it the two are equal"),
        base::field("stated_friction", &Plant::stated_friction_n, friction,
                    "the friction that it states and models use; without it the true one"));
}

} // namespace hapnet::device
