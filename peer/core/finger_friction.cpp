// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/finger_friction.hpp"

#include <cmath>

namespace hapnet::peer {

namespace {

double product(const glm::dvec3& a, const glm::dvec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Returns the component of a vector that is perpendicular to a unit vector.
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& unit)
{
    return v - product(v, unit) * unit;
}

} // namespace

base::Force FingerFriction::on_body(const scene::HandInput& hand, const scene::BodyState& body)
{
    if (!hand.present) contact_.reset();
    if (!contact_) return {};
    const glm::dvec3 place = hand.position.value - body.position.value;
    if (!contact_->anchor) contact_->anchor = place;
    const glm::dvec3 stretch = across(place - *contact_->anchor, contact_->normal);
    const glm::dvec3 speed = across(hand.velocity.value - body.velocity.value, contact_->normal);
    const base::Force force{hips_.stiffness_n_per_m * stretch + hips_.damping_ns_per_m * speed};
    const double most = hips_.friction * contact_->force_n;
    if (base::norm(force) <= most) return force;
    const base::Force slipping = base::limited(force, most);
    if (hips_.stiffness_n_per_m > 0.0) {
        contact_->anchor = place - slipping.value / hips_.stiffness_n_per_m;
    }
    return slipping;
}

void FingerFriction::on_touch(const scene::HandTouch& touch)
{
    const double force_n = base::norm(touch.on_body);
    if (!touch.touching || touch.holding || !(force_n > 0.0)) {
        contact_.reset();
        return;
    }
    const glm::dvec3 normal = touch.on_body.value / force_n;
    constexpr double same_face = 0.7; // cosine of about half the angle between two faces of a box
    if (!contact_ || product(contact_->normal, normal) < same_face) contact_ = Contact{};
    contact_->normal = normal;
    contact_->force_n = force_n;
}

} // namespace hapnet::peer
