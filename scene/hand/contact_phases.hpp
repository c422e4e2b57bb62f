// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/contact_modes.hpp"
#include "scene/hand/surface.hpp"

#include <array>
#include <span>

namespace hapnet::scene {

/// A rigid body through one tick under one or two unilateral springs: from one moment to the next
/// at which a spring begins or ends, or its direction has turned too far to be held. In between,
/// normals, arms and inertia are held as they are halfway, which is of second order; depths,
/// impulses and displacements are in closed form. In the end the speed relative to the hand is
/// scaled by the little that makes the springs' energy what the true depth says (a discrete
/// gradient in the sense of O. Gonzalez, J. Nonlinear Sci. 6, 1996): bounces keep their energy.
template <std::size_t count>
class ContactPhases {
public:
    ContactPhases(MovingBody& body, const BodyDynamics& dynamics, double tick);

    /// The i-th spring; all have to be set before the tick.
    void set(std::size_t i, const HandSpring& spring, SpringImpulse& work);
    /// Goes through the tick. False, with how much is left in `left()`, when there is no closed
    /// form, or phases end again and again.
    [[nodiscard]] bool advance();
    [[nodiscard]] double time_left() const { return time_left_; }
    [[nodiscard]] const glm::dmat3& inverse_inertia() const { return inverse_inertia_; }
    /// The springs as they are now.
    [[nodiscard]] std::array<HandSpring, count> current() const;

private:
    /// The geometry that is held for an interval.
    struct HeldGeometry {
        glm::dmat3 inverse_inertia{0.0};
        std::array<ContactGeometry, count> contacts;
        double normal_change2 = 0.0; // squared change of the normal that turns farthest
    };

    [[nodiscard]] HeldGeometry geometry_halfway(double time) const;
    [[nodiscard]] Coupling set_couplings(const HeldGeometry& held);
    void apply(const HeldGeometry& held, const PhaseImpulses<count>& impulses);
    void begin_contact(std::size_t i);
    void correct_energies();

    MovingBody& body_;
    const BodyDynamics& dynamics_;
    double tick_;
    double time_left_;
    bool rotates_;
    double largest_normal_change_ = 0.0; // squared: largest change of a normal in a phase
    glm::dmat3 inverse_inertia_;         // at the present time
    glm::dmat3 axes_;                    // axes of the body at the present time
    std::array<const HandSpring*, count> springs_{};
    std::array<SpringImpulse*, count> works_{};
    std::array<BoxSurface, count> surfaces_;
    std::array<glm::dvec3, count> hand_positions_{}; // present positions, from the body's centre
    std::array<ContactGeometry, count> geometries_;  // at the present time
    std::array<bool, count> is_amid_face_{};
    std::array<SpringContact, count> contacts_;
};

extern template class ContactPhases<1>;
extern template class ContactPhases<2>;

/// Advances a body that no hand touches.
void advance_freely(MovingBody& body, const BodyDynamics& dynamics, double tick);

} // namespace hapnet::scene
