// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

/// Of the work, J, of an impulse on the surface of a kinematic body the other gets no more than it
/// takes by its own motion: what cannot follow, because it is locked or wedged, gets no energy, and
/// its impulse may be any.
[[nodiscard]] inline double driven_energy(double given, double taken)
{
    // What pushes a body at rest gives it all that it gains, but for rounding.
    constexpr double rounding = 1e-12;
    return std::min(given, taken + rounding * std::abs(taken));
}

/// What kinematic bodies did to a body in touches within a tick.
struct DrivenEnergy {
    double energy = 0.0; // J
    double speed = 0.0;  // m/s: of their surfaces there, at most

    void add(const DrivenEnergy& other)
    {
        energy += other.energy;
        speed = std::max(speed, other.speed);
    }
    /// No more of it, J, than impulses at that speed could do that leave so much momentum, N s: in
    /// a wedge touches push to and fro without end.
    [[nodiscard]] double within(double passed) const
    {
        return energy <= 0.0 ? energy : std::min(energy, speed * passed);
    }
};

} // namespace hapnet::scene
