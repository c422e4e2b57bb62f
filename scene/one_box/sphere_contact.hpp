// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/sphere_box.hpp"
#include "scene/maths/vector.hpp"

#include <cmath>
#include <optional>

namespace hapnet::scene {

/// A hand in the frame of a box: its place from the box's centre, and its velocity relative to the
/// box's.
struct SphereMotion {
    PerAxis from_centre{};
    PerAxis velocity{};
    double radius = 0.0;
    double tick = 0.0;
};

/// The contact of a hand's sphere and a box within a tick. The normal holds for the whole tick.
struct SphereContact {
    BoxFace face;          // none at an edge or a corner
    double depth = 0.0;    // at the start of the tick, along the normal; < 0: still apart
    PerAxis edge_normal{}; // at an edge or a corner: the unit normal, from the box to the hand
};

/// The vector to a place from the closest point of a box around the origin.
struct OutsideVector {
    PerAxis away{};
    std::size_t axis = 0;       // axis along which `away` is longest
    std::size_t directions = 0; // number of nonzero components of `away`: 0 inside, 1 before a face

    OutsideVector(const PerAxis& place, const PerAxis& half)
    {
        for (std::size_t i = 0; i < 3; ++i) {
            const double beyond = std::abs(place[i]) - half[i];
            if (!(beyond > 0.0)) continue;
            away[i] = place[i] < 0.0 ? -beyond : beyond;
            if (directions == 0 || beyond > std::abs(away[axis])) axis = i;
            ++directions;
        }
    }
    [[nodiscard]] BoxFace face() const { return face_at(axis, away[axis]); }
    [[nodiscard]] bool is_along(std::size_t i) const
    {
        return directions == 0 || (directions == 1 && axis == i);
    }
    [[nodiscard]] double length() const
    {
        return directions == 1 ? std::abs(away[axis]) : std::sqrt(dot(away, away));
    }
    [[nodiscard]] PerAxis direction() const
    {
        const double distance = length();
        return {away[0] / distance, away[1] / distance, away[2] / distance};
    }
};

[[nodiscard]] inline SphereContact contact_at_face(const PerAxis& from_centre, const PerAxis& half,
                                                   BoxFace face, double radius)
{
    return {face, radius + half[face.axis] - face.sign * from_centre[face.axis], {}};
}

/// Finds where a hand's sphere touches a box at the start of the tick, or may touch it within the
/// tick. Returns nullopt if it does neither. While the sphere's centre is outside the box, the
/// box's closest point decides. Inside, the face through which the centre entered decides. A sphere
/// that is suddenly inside gets the nearest face. A sphere that is still apart gets the face that
/// it would reach at its present velocity.
[[nodiscard]] std::optional<SphereContact> collide_sphere(const SphereMotion& hand,
                                                          const PerAxis& half, BoxFace& entered);

} // namespace hapnet::scene
