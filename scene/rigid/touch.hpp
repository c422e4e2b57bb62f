// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/solver/contact_block.hpp"

namespace hapnet::scene {

/// A body as it is at a touch. A kinematic one moves, with no response.
struct Toucher {
    bool moves = false;
    glm::dvec3 centre{0.0};
    BodyResponse response;
    BodyMotion motion;
};

/// The impulse at a moment at which two touch: each point that approaches faster than
/// `bounces_from` bounces, and none approaches afterwards; no energy is gained. Zero when no point
/// approaches. Builds the block's matrix.
[[nodiscard]] ContactVector touch_impulse(ContactBlock& block, const Toucher& a, const Toucher& b,
                                          double bounces_from);

/// Adds an impulse to a body's velocity and angular momentum.
void apply_impulse(Bodies& bodies, Slot slot, const Wrench& push, const glm::dvec3& arm);

} // namespace hapnet::scene
