// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"

namespace hapnet::scene {

/// A body at the end of its tick.
struct EnergyCorrection {
    MovingBody& body;
    const BodyDynamics& dynamics;
    const glm::dmat3& inverse_inertia; // now
    double tick = 0.0;
};

/// The depth of a spring that presses, as it followed from what was held, and as it is.
struct SpringDepths {
    double followed = 0.0;
    double true_m = 0.0;
};

/// Scales the speed relative to the hand by the little that makes the spring's energy what the
/// true depth says; no more than the spring can give in the tick.
void correct_energy(const EnergyCorrection& settling, const HandSpring& spring,
                    const SpringDepths& depths, SpringImpulse& work);

} // namespace hapnet::scene
