// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"
#include "scene/hand/friction.hpp"

#include <cstdint>
#include <span>

namespace hapnet::scene {

/// Returns the energy of a spring that is pressed or stretched by `depth`. Beyond its greatest
/// force it grows linearly.
[[nodiscard]] inline double spring_energy(const HandSpring& spring, double depth)
{
    if (depth <= 0.0) return 0.0;
    const double force = spring.stiffness * depth;
    if (force <= spring.force_max) return 0.5 * force * depth;
    return spring.force_max * (depth - 0.5 * spring.force_max / spring.stiffness);
}

/// The data of a body's tick under its hands.
struct HandTick {
    const MovingBody& start;
    MovingBody& end;
    const BodyDynamics& dynamics;
    double tick = 0.0;
};

/// Selects if the energy that the springs store at the end counts.
enum class SpringsAtEnd : std::uint8_t { ignored, counted };

/// Makes the hands passive: they give a body no more energy than their springs had stored plus the
/// work of their own motion. They may lose any energy. When an outcome has more, the impulses of
/// all springs are scaled by one share, towards the tick without hands. The impulses are also
/// scaled when a spring gave more than its greatest force can give.
///
/// Kinetic energy is 1/2 m v^2 + 1/2 L I^-1 L, with the inertia at the start of the tick. It is a
/// parabola in the share, so the largest passive share has a formula, and share 0 is passive. When
/// the moments of inertia differ, this energy is uncertain by the body's turn in the tick. Half of
/// that is tolerated: the spin at the end may be the smaller one. A grip gives at most the energy
/// of GripEnergy, whatever it had stored.
///
/// When the springs at the end are counted, their stored energy counts as given, too, with the
/// inertia at the end. A rule of second order may gain 3 % there, as it holds directions that turn.
HandEnergy keep_passive(const HandTick& body, std::span<const HandSpring> springs,
                        std::span<SpringImpulse> work, SpringsAtEnd at_end);
/// As above, with friction: the energy stored along the surfaces counts, too.
HandEnergy keep_passive(const HandTick& body, const FrictionContacts& contacts);

} // namespace hapnet::scene
