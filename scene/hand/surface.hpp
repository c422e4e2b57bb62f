// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"

#include <glm/geometric.hpp>

namespace hapnet::scene {

/// The place and the direction in which a hand's spring acts on a body, at one moment.
struct ContactGeometry {
    glm::dvec3 normal{0.0}; // unit, from the body to the hand
    glm::dvec3 lever{0.0};  // arm x normal
    double depth = 0.0;     // > 0: overlap
};

/// A box and a hand's sphere near it, in the box's frame. It finds their contact while the box
/// turns and the hand moves on. The nearest point of the box counts, but a sphere whose centre is
/// within the box stays at the face where it was at the start. A round body is represented by its
/// core, and the sphere is then larger by the rounding.
class BoxSurface {
public:
    BoxSurface() = default;
    /// `axes` are the axes of the body in the world's frame.
    BoxSurface(const HandSpring& spring, const BodyDynamics& dynamics, const glm::dmat3& axes);

    /// True if the contact was at a face at the start.
    [[nodiscard]] bool is_face() const { return is_face_; }
    /// True if the contact is at a face, and the hand too far from its edges to leave it soon.
    [[nodiscard]] bool is_amid_face(const glm::dmat3& axes, const glm::dvec3& hand) const;

    /// Returns the geometry with the hand's centre at `hand`, seen from the body's centre in the
    /// world's frame.
    [[nodiscard]] ContactGeometry at(const glm::dmat3& axes, const glm::dvec3& hand) const;

private:
    [[nodiscard]] ContactGeometry at_box(const glm::dmat3& axes, const glm::dvec3& hand) const;

    glm::dvec3 half_{0.0};
    double radius_ = 0.0;
    const BodyPart* part_ = nullptr;
    glm::dvec3 face_{0.0}; // normal of the face, in the box's frame
    bool is_face_ = false;
};

/// Returns the mass of a body along each axis; 0 where it is locked.
[[nodiscard]] glm::dvec3 mass_of(const BodyDynamics& dynamics);

/// A body at the end of its tick.
struct EnergyCorrection {
    MovingBody& body;
    const BodyDynamics& dynamics;
    const glm::dmat3& inverse_inertia; // in the present orientation
    double tick = 0.0;
};

/// The depth of a spring that presses: the value that followed from the held geometry, and the true
/// one.
struct SpringDepths {
    double followed = 0.0;
    double true_m = 0.0;
};

/// Corrects the speed relative to the hand slightly, so that the spring's energy is that of the
/// true depth. The correction is at most what the spring can give in the tick. It may remove any
/// energy but adds only a little, as a geometry that is slightly off explains no more.
void correct_energy(const EnergyCorrection& settling, const HandSpring& spring,
                    const SpringDepths& depths, SpringImpulse& work);

} // namespace hapnet::scene
