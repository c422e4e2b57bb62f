// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <vector>

namespace hapnet::scene {

/// The frame of a body's mass: its centre, and axes about which it has no products of inertia. A
/// body of one part has that part's own frame, as described.
struct MassFrame {
    base::Position centre{};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};
[[nodiscard]] MassFrame frame_of_mass(const BodyDescription& body);

/// The moments of inertia about those axes, kg m^2: of a box as below; of a sphere 2/5 m r^2; of a
/// capsule those of a cylinder and of two half spheres, whose middles are three eighths of the
/// radius beyond it; of several parts the sum of theirs, each moved there (Steiner). A part has the
/// share of the mass that it has of the volume.
[[nodiscard]] glm::dvec3 inertia_of(const BodyDescription& body);
/// The moments of inertia of a solid box about its axes, kg m^2: m/3 (b^2 + c^2) with half edges.
[[nodiscard]] glm::dvec3 box_inertia(double mass_kg, const glm::dvec3& half);

/// A part of a body, in the frame of its mass.
struct BodyPart {
    glm::dvec3 at{0.0}; // its centre, from the body's
    glm::dmat3 axes{1.0};
    glm::dvec3 half{0.02};
    double rounding = 0.0;
    double radius = 0.0; // m: how far it reaches from the body's centre
};
/// Returns all parts of a body, the first one first.
[[nodiscard]] std::vector<BodyPart> parts_of(const BodyDescription& body);
/// Half the edges of a box around its centre of mass that has all parts in it.
[[nodiscard]] glm::dvec3 half_around(const std::vector<BodyPart>& parts);

} // namespace hapnet::scene
