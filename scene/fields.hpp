// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/state.hpp"

namespace hapnet::scene {

// Fields of force: see FieldDescription. They act from outside, so that every stepper has them.

/// The push of a field on a body at the start of a tick, held until its end: that of the implicit
/// midpoint rule, which neither gains nor loses energy in a spring however stiff; with what the
/// damping takes as in its exponential law. N.
[[nodiscard]] glm::dvec3 force_on_body(const FieldDescription& field, const WorldConfig& config,
                                       const Bodies& bodies, Slot slot);

/// Adds the forces on the hands to what they feel: the mean over the tick, in which a hand keeps
/// its velocity.
void feel_fields(const WorldConfig& config, WorldState& state);

} // namespace hapnet::scene
