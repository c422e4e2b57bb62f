// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/intention.hpp"

#include "proto/base/math.hpp"

#include <glm/geometric.hpp>

namespace hapnet::peer {

HandDynamics dynamics_of(const wire::HandModel& said)
{
    HandDynamics hand;
    if (said.mass > 0.0F) hand.mass_kg = static_cast<double>(said.mass);
    if (said.damping > 0.0F) hand.damping_ns_per_m = static_cast<double>(said.damping);
    if (said.stiffness > 0.0F) hand.stiffness_n_per_m = static_cast<double>(said.stiffness);
    hand.friction_n = static_cast<double>(said.friction);
    return hand;
}

wire::HandModel hand_model_of(const device::Capabilities& capabilities)
{
    return {.friction = static_cast<float>(capabilities.friction_n)};
}

void Intention::add(const Sample& sample, base::TimePoint at)
{
    const glm::dvec3 pull = hand_.damping_ns_per_m * sample.velocity.value - sample.force.value;
    const glm::dvec3 raw = sample.hip.value + pull / hand_.stiffness_n_per_m;
    if (!is_known_) {
        is_known_ = true;
        velocity_ = sample.velocity.value;
        settled_ = raw;
        filter_.restart(raw, at);
        return;
    }
    if (const base::Duration apart = at - filter_.at(); apart != tick_) {
        tick_ = apart;
        share_ = 1.0 - base::exp(-base::to_seconds(apart) / velocity_filter_s);
    }
    velocity_ += share_ * (sample.velocity.value - velocity_);
    settled_ = within_friction(raw);
    filter_.add(settled_, at);
}

void Intention::say(wire::State& state, base::Position hip, base::Velocity hip_velocity) const
{
    state.hip = hip;
    state.hip_velocity = state.intention_velocity = hip_velocity;
    if (!is_known_) return;
    state.intention = place() - hip;
    state.intention_velocity = velocity();
}

/// With friction, the intention is a set and not a point. A hand that sticks shows nothing about
/// where in the set it intends to be. If the estimate were taken for the point, the intention would
/// seem to move with the force.
glm::dvec3 Intention::within_friction(const glm::dvec3& raw) const
{
    const double reach_m = hand_.friction_n / hand_.stiffness_n_per_m;
    const double speed = glm::length(velocity_);
    if (speed > slides_above_m_per_s) return raw + (reach_m / speed) * velocity_;
    const glm::dvec3 off = settled_ - raw;
    const double distance = glm::length(off);
    return distance > reach_m ? raw + (reach_m / distance) * off : settled_;
}

} // namespace hapnet::peer
