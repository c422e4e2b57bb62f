// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/contact_phases.hpp"

#include "scene/hand/plane_drag.hpp"
#include "scene/hand/surface.hpp"
#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

constexpr int phases_max = 64; // greatest number of phases in a tick
// The least share of a tick that is split off only because a direction turns.
constexpr double part_min = 1.0 / 32.0;
// The greatest rotation of a normal in half an interval at which its mean is right to 1e-5.
constexpr double normal_rotation_max = 0.01;

glm::dmat3 rotated_inertia(const glm::dmat3& inverse_inertia, const glm::dvec3& angle)
{
    const glm::dmat3 turn = axes_of(rotation_by(angle));
    return turn * inverse_inertia * glm::transpose(turn);
}

bool is_zero(const glm::dmat3& m) { return m[0][0] == 0.0 && m[1][1] == 0.0 && m[2][2] == 0.0; }

} // namespace

void advance_freely(MovingBody& body, const BodyDynamics& dynamics, double tick)
{
    if (dynamics.drag == 0.0) {
        body.position += tick * (body.velocity + (0.5 * tick) * dynamics.acceleration);
        body.velocity += tick * dynamics.acceleration;
    } else {
        const PlaneDrag drag{dynamics, tick};
        body.position += tick * drag.mean_velocity(body.velocity, dynamics.acceleration);
        body.velocity = drag.velocity_after(body.velocity, dynamics.acceleration);
    }
    if (is_zero(dynamics.inverse_inertia)) return;
    const glm::dvec3 mean = body.angular_momentum + (0.5 * tick) * dynamics.torque;
    glm::dvec3 angle = tick * (dynamics.inverse_inertia * mean);
    if (!dynamics.rotates_uniformly)
        angle = tick * (rotated_inertia(dynamics.inverse_inertia, 0.5 * angle) * mean);
    body.orientation = rotated(body.orientation, angle);
    body.angular_momentum += tick * dynamics.torque;
}

template <std::size_t count>
ContactPhases<count>::ContactPhases(MovingBody& body, const BodyDynamics& dynamics, double tick)
    : body_{body},
      dynamics_{dynamics},
      tick_{tick},
      time_left_{tick},
      rotates_{!is_zero(dynamics.inverse_inertia)},
      inverse_inertia_{dynamics.inverse_inertia},
      axes_{axes_of(body.orientation)}
{}

template <std::size_t count>
void ContactPhases<count>::set(std::size_t i, const HandSpring& spring, SpringImpulse& work)
{
    springs_[i] = &spring;
    works_[i] = &work;
    surfaces_[i] = BoxSurface{spring, dynamics_, axes_};
    hand_positions_[i] = spring.arm + (spring.radius + spring.gap) * spring.normal;
    is_amid_face_[i] = surfaces_[i].is_amid_face(axes_, hand_positions_[i]);
    ContactGeometry& geometry = geometries_[i];
    geometry = {spring.normal, glm::cross(spring.arm, spring.normal), -spring.gap};
    SpringContact& contact = contacts_[i];
    contact.stiffness = spring.stiffness;
    contact.damping = spring.damping;
    contact.force_max = spring.force_max;
    contact.depth = -spring.gap;
    contact.closing = glm::dot(spring.normal, body_.velocity - spring.velocity) +
                      glm::dot(geometry.lever, inverse_inertia_ * body_.angular_momentum);
    contact.phase = contact.phase_due();
}

template <std::size_t count>
typename ContactPhases<count>::HeldGeometry
ContactPhases<count>::geometry_halfway(double time) const
{
    const double half = 0.5 * time;
    glm::dvec3 force{0.0};
    glm::dvec3 torque = dynamics_.torque;
    for (std::size_t i = 0; i < count; ++i) {
        const double pushed = contacts_[i].force();
        force -= pushed * geometries_[i].normal;
        torque -= pushed * geometries_[i].lever;
    }
    const glm::dvec3 moved =
        half *
        (body_.velocity + (0.5 * half) * (dynamics_.acceleration + dynamics_.inverse_mass * force));
    HeldGeometry held{inverse_inertia_, geometries_};
    glm::dvec3 angle{0.0};
    if (rotates_) {
        angle = half * (inverse_inertia_ * (body_.angular_momentum + (0.5 * half) * torque));
        if (!dynamics_.rotates_uniformly)
            held.inverse_inertia = rotated_inertia(inverse_inertia_, angle);
    }
    const bool turns_little = glm::dot(angle, angle) <= normal_rotation_max * normal_rotation_max;
    for (std::size_t i = 0; i < count; ++i) {
        if (!rotates_ && surfaces_[i].is_face()) continue;
        ContactGeometry& geometry = held.contacts[i];
        const glm::dvec3 hand = hand_positions_[i] + half * springs_[i]->velocity - moved;
        if (is_amid_face_[i] && turns_little) {
            // The face's normal turns with the body, but so little that two terms of the rotation
            // suffice for the held geometry.
            const glm::dvec3 once = glm::cross(angle, geometries_[i].normal);
            geometry.normal = geometries_[i].normal + once + 0.5 * glm::cross(angle, once);
            geometry.lever = glm::cross(hand, geometry.normal);
        } else {
            geometry = surfaces_[i].at(axes_of(rotation_by(angle) * body_.orientation), hand);
        }
        const glm::dvec3 change = geometry.normal - geometries_[i].normal;
        held.normal_change2 = std::max(held.normal_change2, glm::dot(change, change));
    }
    return held;
}

template <std::size_t count>
Coupling ContactPhases<count>::set_couplings(const HeldGeometry& held)
{
    Coupling coupling;
    std::array<glm::dvec3, count> inverse_inertia_lever{};
    for (std::size_t i = 0; i < count; ++i) {
        const ContactGeometry& geometry = held.contacts[i];
        SpringContact& contact = contacts_[i];
        inverse_inertia_lever[i] = held.inverse_inertia * geometry.lever;
        coupling.own[i] = glm::dot(geometry.normal, dynamics_.inverse_mass * geometry.normal) +
                          glm::dot(geometry.lever, inverse_inertia_lever[i]);
        contact.closing = glm::dot(geometry.normal, body_.velocity - springs_[i]->velocity) +
                          glm::dot(inverse_inertia_lever[i], body_.angular_momentum);
        contact.acceleration = glm::dot(geometry.normal, dynamics_.acceleration) +
                               glm::dot(inverse_inertia_lever[i], dynamics_.torque);
    }
    if constexpr (count == 2)
        coupling.mutual =
            glm::dot(held.contacts[0].normal, dynamics_.inverse_mass * held.contacts[1].normal) +
            glm::dot(held.contacts[0].lever, inverse_inertia_lever[1]);
    return coupling;
}

template <std::size_t count>
bool ContactPhases<count>::advance()
{
    for (int phase = 0; phase < phases_max && time_left_ > 0.0; ++phase) {
        double time = time_left_;
        double predicted = time; // `held` is the geometry in the middle of this time
        for (int attempt = 0;; ++attempt) {
            const HeldGeometry held = geometry_halfway(predicted);
            const Coupling coupling = set_couplings(held);
            double shorter = time;
            if (held.normal_change2 > normal_rotation_max * normal_rotation_max)
                shorter = predicted * normal_rotation_max / std::sqrt(held.normal_change2);
            for (std::size_t i = 0; i < count && rotates_; ++i) {
                const double square = coupling.own[i] * contacts_[i].stiffness;
                if (contacts_[i].phase == SpringPhase::pressing && square * time * time > 1.0)
                    shorter = std::min(shorter, 1.0 / std::sqrt(square));
            }
            shorter = std::max(shorter, part_min * tick_);
            if (attempt < 3 && shorter < 0.99 * time) {
                time = predicted = shorter;
                continue;
            }
            auto contacts = contacts_;
            ContactModes<count> motion{contacts, coupling, time};
            if (!motion.is_solved()) return false;
            const PhaseImpulses<count> impulses = motion.advance();
            if (attempt < 3 && impulses.time < 0.75 * predicted && rotates_) {
                predicted = impulses.time;
                attempt = 3;
                continue;
            }
            std::array<bool, count> was_apart{};
            for (std::size_t i = 0; i < count; ++i)
                was_apart[i] = contacts_[i].phase == SpringPhase::apart;
            contacts_ = contacts;
            apply(held, impulses);
            for (std::size_t i = 0; i < count; ++i) {
                if (was_apart[i]) begin_contact(i);
            }
            break;
        }
    }
    if (time_left_ > 0.0) return false;
    correct_energies();
    return true;
}

template <std::size_t count>
void ContactPhases<count>::apply(const HeldGeometry& held, const PhaseImpulses<count>& impulses)
{
    const double t = impulses.time;
    glm::dvec3 impulse{0.0};
    glm::dvec3 moment{0.0};
    glm::dvec3 twist{0.0};
    glm::dvec3 twist_moment{0.0};
    for (std::size_t i = 0; i < count; ++i) {
        const ContactGeometry& geometry = held.contacts[i];
        impulse -= impulses.impulse[i] * geometry.normal;
        moment -= impulses.moment[i] * geometry.normal;
        twist -= impulses.impulse[i] * geometry.lever;
        twist_moment -= impulses.moment[i] * geometry.lever;
        works_[i]->impulse -= impulses.impulse[i] * geometry.normal;
    }
    const glm::dvec3 moved =
        t * (body_.velocity + (0.5 * t) * dynamics_.acceleration) + dynamics_.inverse_mass * moment;
    body_.position += moved;
    body_.velocity += t * dynamics_.acceleration + dynamics_.inverse_mass * impulse;
    for (std::size_t i = 0; i < count; ++i) hand_positions_[i] += t * springs_[i]->velocity - moved;
    if (rotates_) {
        const glm::dvec3 swept =
            t * (body_.angular_momentum + (0.5 * t) * dynamics_.torque) + twist_moment;
        const glm::dvec3 angle = held.inverse_inertia * swept;
        body_.angular_momentum += t * dynamics_.torque + twist;
        body_.orientation = rotated(body_.orientation, angle);
        axes_ = axes_of(body_.orientation);
        if (!dynamics_.rotates_uniformly)
            inverse_inertia_ = rotated_inertia(inverse_inertia_, angle);
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!rotates_ && surfaces_[i].is_face()) continue;
        const glm::dvec3 before = geometries_[i].normal;
        geometries_[i] = surfaces_[i].at(axes_, hand_positions_[i]);
        const glm::dvec3 change = geometries_[i].normal - before;
        largest_normal_change_ = std::max(largest_normal_change_, glm::dot(change, change));
    }
    time_left_ = t < time_left_ ? time_left_ - t : 0.0;
}

template <std::size_t count>
void ContactPhases<count>::begin_contact(std::size_t i)
{
    // A spring that was apart stores nothing. It must not begin before its depth is reached. If it
    // begins a little late, correct_energy() compensates for that in the end.
    SpringContact& contact = contacts_[i];
    contact.depth = geometries_[i].depth;
    if (contact.phase != SpringPhase::pressing) return;
    constexpr double near = 1e-9;
    if (contact.depth < -near * contact.closing * tick_) contact.phase = SpringPhase::apart;
    contact.depth = std::min(contact.depth, 0.0);
}

template <std::size_t count>
std::array<HandSpring, count> ContactPhases<count>::current() const
{
    std::array<HandSpring, count> springs;
    for (std::size_t i = 0; i < count; ++i) {
        HandSpring& spring = springs[i];
        spring = *springs_[i];
        spring.normal = geometries_[i].normal;
        spring.gap = -contacts_[i].depth;
        spring.arm = hand_positions_[i] - (spring.radius + spring.gap) * spring.normal;
    }
    return springs;
}

template <std::size_t count>
void ContactPhases<count>::correct_energies()
{
    // Pure rounding is not corrected: a symmetric squeeze must stay in its place.
    constexpr double unturned = 1e-10;
    if (largest_normal_change_ < unturned * unturned) return;
    for (std::size_t i = 0; i < count; ++i) {
        if (contacts_[i].phase == SpringPhase::apart) continue;
        scene::correct_energy({body_, dynamics_, inverse_inertia_, tick_}, *springs_[i],
                              {contacts_[i].depth, geometries_[i].depth}, *works_[i]);
    }
}

template class ContactPhases<1>;
template class ContactPhases<2>;

} // namespace hapnet::scene
