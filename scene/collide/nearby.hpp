// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/box_box.hpp"
#include "scene/rigid/integrate.hpp"

namespace hapnet::scene {

/// How far any part of an awake body may come in the tick, and a little more, metres.
[[nodiscard]] double reach_of(const Bodies& bodies, Slot slot, const Scales& scales);

/// A box and where it is going.
struct BoxSweep {
    const OrientedBox& box;
    glm::dvec3 velocity{0.0};
    double reach = 0.0;
    double radius = 0.0; // of the corners
};

/// Where two boxes touch, and their centres then.
struct SweptContact {
    Manifold manifold;
    ContactPlaces centres;
};

/// Where two boxes touch, or will within the tick. Of boxes that come far in it, where they will
/// when they meet, with the way that they have until then as the separation: they cannot pass
/// through each other.
[[nodiscard]] SweptContact collide_swept(const BoxSweep& a, const BoxSweep& b, double tick,
                                         BoxBoxMemory& memory);

} // namespace hapnet::scene
