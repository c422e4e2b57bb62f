// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <vector>

namespace hapnet::scene {

/// The frame of a body's mass: its centre of mass, and axes about which it has no products of
/// inertia. For a body of one part it is that part's own frame, as described.
struct MassFrame {
    base::Position centre{};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};
[[nodiscard]] MassFrame frame_of_mass(const BodyDescription& body);

/// Returns the moments of inertia about the axes of frame_of_mass(), kg m^2. A box: see
/// box_inertia(). A sphere: 2/5 m r^2. A capsule: those of a cylinder and two half spheres, whose
/// centres of mass are three eighths of the radius beyond the cylinder's ends. Several parts: the
/// sum of the parts' moments, each moved to the common centre (Steiner). A part's share of the mass
/// is its share of the volume.
[[nodiscard]] glm::dvec3 inertia_of(const BodyDescription& body);
/// Returns the moments of inertia of a solid box about its axes, kg m^2: m/3 (b^2 + c^2) with half
/// edges.
[[nodiscard]] glm::dvec3 box_inertia(double mass_kg, const glm::dvec3& half);

/// A part of a body, in the frame of the body's mass.
struct BodyPart {
    glm::dvec3 at{0.0}; // the part's centre, from the body's
    glm::dmat3 axes{1.0};
    glm::dvec3 half{0.02};
    double rounding = 0.0;
    double radius = 0.0; // m: greatest distance of the part's surface from the body's centre
};
/// Returns all parts of a body, the first one first.
[[nodiscard]] std::vector<BodyPart> parts_of(const BodyDescription& body);
/// Returns half the edges of a box around the body's centre of mass that contains all parts.
[[nodiscard]] glm::dvec3 half_around(const std::vector<BodyPart>& parts);

} // namespace hapnet::scene
