// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

/// Returns the part of the work `given`, J, of a kinematic body's impulse that the other body gets.
/// It gets no more than `taken`, J, the work of the impulse on its own motion. A locked or wedged
/// body cannot follow and gets no energy, however large the impulse is.
[[nodiscard]] inline double driven_energy(double given, double taken)
{
    // The energy that a body at rest gains comes from the bodies that push it, except for rounding.
    constexpr double rounding = 1e-12;
    return std::min(given, taken + rounding * std::abs(taken));
}

/// The work of kinematic bodies on a body in touches within a tick.
struct DrivenEnergy {
    double energy = 0.0; // J
    double speed = 0.0;  // m/s: greatest speed of the kinematic surfaces at the touches

    void add(const DrivenEnergy& other)
    {
        energy += other.energy;
        speed = std::max(speed, other.speed);
    }
    /// Returns the energy, J, limited to the work of impulses at that speed that leave the momentum
    /// `passed`, N s. In a wedge, touches push to and fro without end.
    [[nodiscard]] double within(double passed) const
    {
        return energy <= 0.0 ? energy : std::min(energy, speed * passed);
    }
};

} // namespace hapnet::scene
