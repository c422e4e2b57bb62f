// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/joints/plant.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <glm/glm.hpp>

namespace hapnet::device {

namespace {

// The number of rounds that balance the friction impulses of the joints, which are nearly
// independent.
constexpr int friction_rounds = 4;

/// Returns the tip's acceleration while the joints turn at constant speed.
glm::dvec3 turning_acceleration(const omni::Joints& joints, const glm::dvec3& turning)
{
    const glm::dvec3& q = joints.angles;
    const double sine = base::sin(q.x);
    const double cosine = base::cos(q.x);
    const glm::dvec2 shoulder{base::cos(q.y), base::sin(q.y)};
    const glm::dvec2 forearm{base::sin(q.z), -base::cos(q.z)};
    const double reach = omni::link_m * (shoulder.x + forearm.x);
    const double speed = omni::link_m * (-shoulder.y * turning.y - forearm.y * turning.z);
    const double upper = omni::link_m * turning.y * turning.y;
    const double fore = omni::link_m * turning.z * turning.z;
    const double outward = -upper * shoulder.x - fore * forearm.x - reach * turning.x * turning.x;
    const double sideways = 2.0 * speed * turning.x;
    return {-outward * sine - sideways * cosine, -upper * shoulder.y - fore * forearm.y,
            outward * cosine - sideways * sine};
}

/// Stops a motion that leaves a range.
void stop(double& angle, double& turning, const omni::JointRange& range)
{
    if (angle >= range.least && angle <= range.most) return;
    angle = std::clamp(angle, range.least, range.most);
    turning = 0.0;
}

} // namespace

JointPlant::JointPlant(const JointPlantFigures& figures)
    : figures_{figures},
      joints_{figures.begins_docked ? omni::inkwell_pose : omni::joints_of({})},
      is_docked_{figures.begins_docked}
{
    see_where_it_is();
}

void JointPlant::set_torque(const glm::dvec3& newton_metres)
{
    torque_ = base::is_finite(newton_metres)
                  ? glm::clamp(newton_metres, -figures_.torque_max_nm, figures_.torque_max_nm)
                  : glm::dvec3{0.0};
}

void JointPlant::advance(base::Duration elapsed)
{
    const auto steps = (elapsed + step_max - base::Duration{1}) / step_max;
    if (steps <= 0) return;
    const double seconds = base::to_seconds(elapsed) / static_cast<double>(steps);
    for (base::Duration::rep i = 0; i < steps; ++i) {
        if (grip_) grip_->target.value += seconds * grip_->target_velocity.value;
        if (is_docked_ && is_pulled_out()) is_docked_ = false;
        if (is_docked_) continue;
        step(seconds);
        try_the_inkwell();
    }
}

void JointPlant::step(double seconds)
{
    const double mass = grip_ ? grip_->hand.mass_kg : figures_.tip_mass_kg;
    const glm::dmat3 transposed = glm::transpose(jacobian_);
    glm::dmat3 inertia = mass * transposed * jacobian_;
    for (const int joint : {0, 1, 2}) inertia[joint][joint] += figures_.rotor_kg_m2[joint];
    const glm::dmat3 mobility = glm::inverse(inertia);
    const glm::dvec3 at_tip = hand_force() - figures_.tip_damping_ns_per_m * velocity_.value -
                              mass * turning_acceleration(joints_, turning_);
    turning_ += seconds * (mobility * (transposed * at_tip + torque_));
    rub(mobility, seconds);
    joints_.angles += seconds * turning_;
    stop_at_the_ends();
    see_where_it_is();
}

glm::dvec3 JointPlant::hand_force() const
{
    if (!grip_) return glm::dvec3{0.0};
    const HandImpedance& hand = grip_->hand;
    return hand.stiffness_n_per_m * (grip_->target - tip_).value +
           hand.damping_ns_per_m * (grip_->target_velocity - velocity_).value;
}

/// Applies Coulomb friction as the impulse that stops each joint, or as much of it as the friction
/// can give. A joint at rest sticks exactly, and friction only removes motion.
void JointPlant::rub(const glm::dmat3& mobility, double seconds)
{
    glm::dvec3 impulse{0.0};
    const glm::dvec3 most = seconds * figures_.friction_nm;
    for (int round = 0; round < friction_rounds; ++round) {
        for (const int joint : {0, 1, 2}) {
            const double stopping = impulse[joint] - turning_[joint] / mobility[joint][joint];
            const double taken = std::clamp(stopping, -most[joint], most[joint]);
            turning_ += (taken - impulse[joint]) * mobility[joint];
            impulse[joint] = taken;
        }
    }
}

void JointPlant::stop_at_the_ends()
{
    glm::dvec3& q = joints_.angles;
    stop(q.x, turning_.x, omni::waist_range);
    stop(q.y, turning_.y, omni::shoulder_range);
    double elbow = q.z - q.y;
    double bending = turning_.z - turning_.y;
    stop(elbow, bending, omni::elbow_range);
    q.z = q.y + elbow;
    turning_.z = turning_.y + bending;
}

void JointPlant::see_where_it_is()
{
    jacobian_ = omni::jacobian(joints_);
    tip_ = omni::position_of(joints_);
    velocity_ = {jacobian_ * turning_};
}

bool JointPlant::is_pulled_out() const
{
    return grip_ && glm::length(hand_force()) > figures_.dock_hold_n &&
           base::norm(grip_->target - tip_) > figures_.dock_reach_m;
}

void JointPlant::try_the_inkwell()
{
    const base::Position inkwell = omni::position_of(omni::inkwell_pose);
    if (base::norm(tip_ - inkwell) > figures_.dock_reach_m) return;
    if (grip_ && base::norm(grip_->target - inkwell) > figures_.dock_reach_m) return;
    is_docked_ = true;
    joints_ = omni::inkwell_pose;
    turning_ = glm::dvec3{0.0};
    see_where_it_is();
}

} // namespace hapnet::device
