// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/mass.hpp"

namespace hapnet::bench {

/// A body as an engine wants it: where its mass is, and its parts around that.
struct Solid {
    scene::MassFrame frame;
    glm::dvec3 moments{0.0}; // of inertia about the frame's axes, kg m^2
    std::vector<scene::BodyPart> parts;

    [[nodiscard]] bool is_box() const { return parts.size() == 1 && parts[0].rounding == 0.0; }
};

/// What Hapnet computes of a scene before it is given to a peer. A module of its own has no other
/// part of Hapnet's library.
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
