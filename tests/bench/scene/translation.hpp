// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/mass.hpp"

namespace hapnet::bench {

/// A body in the form that engines need: its mass frame, and its parts in that frame.
struct Solid {
    scene::MassFrame frame;
    glm::dvec3 moments{0.0}; // of inertia about the frame's axes, kg m^2
    std::vector<scene::BodyPart> parts;

    [[nodiscard]] bool is_box() const { return parts.size() == 1 && parts[0].rounding == 0.0; }
};

/// Hapnet's computations on a scene for a peer engine. An engine in a module contains no other part
/// of Hapnet's library.
struct Translation {
    scene::Description scene;
    std::vector<Solid> solids;           // of the bodies
    scene::HandFriction hand_friction{}; // of the hands on the first body
};

[[nodiscard]] Translation translate(const scene::Description& scene);

/// Half the length of a capsule's axis, and which of its edges lies along it; 0 for a sphere.
struct Core {
    int axis = 2;
    double half = 0.0;
};
[[nodiscard]] inline Core core_of(const scene::BodyPart& part)
{
    Core core;
    for (int i = 0; i < 3; ++i) {
        const double half = part.half[i] - part.rounding;
        if (half > core.half) core = {i, half};
    }
    return core;
}

} // namespace hapnet::bench
