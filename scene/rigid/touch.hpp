// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/solver/contact_block.hpp"

namespace hapnet::scene {

/// The state of a body at a touch. A kinematic body moves but does not respond.
struct Toucher {
    bool moves = false;
    glm::dvec3 centre{0.0};
    BodyResponse response;
    BodyMotion motion;
};

/// Returns the impulse of a touch at its moment. Each point that approaches faster than
/// `bounces_from` bounces, and no point approaches afterwards. No energy is gained. The impulse is
/// zero when no point approaches. Builds the block's matrix.
[[nodiscard]] ContactVector touch_impulse(ContactBlock& block, const Toucher& a, const Toucher& b,
                                          double bounces_from);

/// Adds an impulse to a body's velocity and angular momentum.
void apply_impulse(Bodies& bodies, Slot slot, const Wrench& push, const glm::dvec3& arm);

} // namespace hapnet::scene
