// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace hapnet::scene {

/// The energy of a spring that is pressed or stretched so far; beyond its greatest force it grows
/// evenly.
[[nodiscard]] inline double spring_energy(const HandSpring& spring, double depth)
{
    if (depth <= 0.0) return 0.0;
    const double force = spring.stiffness * depth;
    if (force <= spring.force_max) return 0.5 * force * depth;
    return spring.force_max * (depth - 0.5 * spring.force_max / spring.stiffness);
}

/// Of a spring at the start of its tick.
[[nodiscard]] inline double stored_energy(const HandSpring& spring)
{
    if (!spring.holds) return spring_energy(spring, -spring.gap);
    return spring_energy(spring, std::sqrt(glm::dot(spring.stretch, spring.stretch)));
}

/// What the springs store at the start, and what the hands' motion did by these impulses.
[[nodiscard]] inline HandEnergy energy_of(std::span<const HandSpring> springs,
                                          std::span<const SpringImpulse> work)
{
    HandEnergy energy;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        energy.stored += stored_energy(springs[i]);
        energy.driven += glm::dot(work[i].impulse, springs[i].velocity);
    }
    return energy;
}

/// A body's tick under its hands.
struct HandTick {
    const MovingBody& start;
    MovingBody& end;
    const BodyDynamics& dynamics;
    double tick = 0.0;
};

/// Whether what the springs store at the end counts.
enum class SpringsAtEnd : std::uint8_t { ignored, counted };

/// Makes the hands passive: they give the body what their springs stored and what their own motion
/// put in, and no more. Where an outcome has more, the impulses of all springs are scaled down by
/// one share, towards the tick without hands; so does a spring that gave more than it can. They
/// may lose any energy. Kinetic energy is 1/2 m v^2 and, with the inertia as it is at the start,
/// 1/2 L I^-1 L: along the share it is a parabola, so that the share is found at once, and 0 always
/// does. What a body that is not a cube turns in the tick makes this energy vague: as much is let
/// pass. Where springs at the end count, what they store then counts as given, but for three
/// hundredths: rules of second order hold directions while they turn.
HandEnergy keep_passive(const HandTick& body, std::span<const HandSpring> springs,
                        std::span<SpringImpulse> work, SpringsAtEnd at_end);

} // namespace hapnet::scene
