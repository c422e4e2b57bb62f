// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/state.hpp"

namespace hapnet::scene {

// Fields of force: see FieldDescription. They act from outside, so every stepper supports them.

/// Returns the force of a field on a body, N, found at the start of a tick and held until its end.
/// The spring's part follows the implicit midpoint rule, which neither gains nor loses energy
/// however stiff the spring is. The damping takes as much as in its exponential law.
[[nodiscard]] glm::dvec3 force_on_body(const FieldDescription& field, const WorldConfig& config,
                                       const Bodies& bodies, Slot slot);

/// Adds the fields' forces on the hands to the forces that the hands feel. Each is the mean over
/// the tick, in which a hand keeps its velocity.
void feel_fields(const WorldConfig& config, WorldState& state);

} // namespace hapnet::scene
