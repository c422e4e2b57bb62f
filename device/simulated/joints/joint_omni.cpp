// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/joints/joint_omni.hpp"

#include "device/simulated/minimum_jerk.hpp"

#include <glm/glm.hpp>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

// The duration of a walk, including the walk out of the inkwell to where the person waits.
constexpr double walk_s = 1.0;
constexpr base::Position waiting_place{{0.0, 0.0, 0.035}};
constexpr int encoder_jump_counts = 500;
// The greatest distance to the side by which paths of tasks leave the workspace. The joints can
// reach it.
constexpr double aside_m = 0.025;

Capabilities capabilities_of(const JointPlantFigures& plant)
{
    const glm::dvec3 reach = omni::half_workspace_m + glm::dvec3{aside_m, 0.0, 0.0};
    Capabilities can;
    can.workspace_min = {-reach};
    can.workspace_max = {reach};
    can.force_max_n = omni::force_max_n;
    can.force_continuous_n = omni::force_continuous_n;
    can.stiffness_max_n_per_m = omni::stiffness_max_n_per_m;
    can.damping_max_ns_per_m = omni::damping_max_ns_per_m;
    can.resolution_m = omni::radians_per_count * omni::link_m;
    can.friction_n = omni::friction_n;
    can.buttons = 2;
    can.has_holder = true;
    can.joints = JointLimits{omni::mechanism, plant.torque_max_nm};
    return can;
}

} // namespace

JointOmni::JointOmni(const JointOmniSettings& settings)
    : capabilities_{capabilities_of(settings.plant)},
      plant_{settings.plant},
      person_{settings.role},
      injected_faults_{settings.injected_faults},
      intended_{plant_.tip()}
{
    const HandImpedance& hand = person_.hand();
    identity_ = {.backend = "sim",
                 .serial = "joints",
                 .model = "simulated Omni, joint by joint",
                 .note = fmt::format("held by a simulated hand, {}: {} kg, {} N s/m, {} N/m",
                                     settings.role.person.name, hand.mass_kg, hand.damping_ns_per_m,
                                     hand.stiffness_n_per_m)};
}

CalibrationStep JointOmni::calibrate(base::TimePoint /*now*/) { return tracker_.calibration(); }

void JointOmni::on_cue(const Cue& cue)
{
    is_cued_ = true;
    person_.on_cue(cue, waiting_place.value);
    if (plant_.is_docked()) lead_to(waiting_place);
}

void JointOmni::lead_to(const base::Position& place) { walk_ = Walk{intended_, place, {}}; }

base::Position JointOmni::walked(base::TimePoint now)
{
    if (!walk_->start) walk_->start = now;
    const double u = base::to_seconds(now - *walk_->start) / walk_s;
    const base::Position there = walk_->from + minimum_jerk(u) * (walk_->to - walk_->from);
    if (u >= 1.0 && is_cued_) walk_.reset(); // from here on the person acts
    return there;
}

Grip JointOmni::grip_at(base::TimePoint now, base::Duration elapsed)
{
    Person::Effort effort{.target = intended_};
    if (walk_) {
        effort.target = walked(now);
    } else if (is_cued_) {
        const glm::dvec3 motors =
            glm::transpose(glm::inverse(omni::jacobian(plant_.joints()))) * plant_.torque();
        const Person::Aim aim = person_.aim(now);
        is_gripping_ = aim.intention.gripping;
        effort = person_.effort(aim, {(plant_.tip() - intended_).value, motors}, now, elapsed);
    }
    const double seconds = base::to_seconds(elapsed);
    const HandImpedance& hand = person_.hand();
    // Forces in addition to the hand's impedance have the same effect as a shifted intention.
    const glm::dvec3 aside = effort.force / hand.stiffness_n_per_m;
    const glm::dvec3 change = (effort.target - intended_).value;
    const Grip grip{{intended_.value + aside}, {change / seconds}, hand};
    intended_ = effort.target;
    return grip;
}

void JointOmni::advance(base::TimePoint now)
{
    const base::Duration elapsed = lived_to_ ? now - *lived_to_ : base::Duration{0};
    lived_to_ = now;
    if (elapsed <= base::Duration{0} || elapsed > gap_max) return;
    plant_.set_grip(grip_at(now, elapsed));
    plant_.advance(elapsed);
}

Sample JointOmni::read(base::TimePoint now)
{
    if (!start_) start_ = now;
    if (halted_.load(std::memory_order_relaxed)) plant_.set_torque({});
    advance(now);
    speak(now);
    Sample sample = tracker_.at(now);
    if (injected_faults_.has(InjectedFault::Kind::not_a_number, now - *start_)) {
        sample.hip = {glm::dvec3{std::numeric_limits<double>::quiet_NaN()}};
    }
    return sample;
}

void JointOmni::speak(base::TimePoint now)
{
    const base::Duration since = now - *start_;
    const auto happens = [&](InjectedFault::Kind kind) {
        return injected_faults_.has(kind, since);
    };
    ++words_;
    if (happens(InjectedFault::Kind::unplug)) tracker_.on_gone();
    if (happens(InjectedFault::Kind::stall)) return;
    if (happens(InjectedFault::Kind::dropped_reports) && words_ % 2 == 0) return;
    if (happens(InjectedFault::Kind::communication_error)) return tracker_.on_nonsense();
    omni::Report word{.counts = plant_.counts(), .docked = plant_.is_docked(), .buttons = pressed_};
    if (is_gripping_) word.buttons |= 1U;
    if (happens(InjectedFault::Kind::encoder_jump)) word.counts.x += encoder_jump_counts;
    tracker_.on_report(word, now);
}

void JointOmni::apply(const GovernedForce& force)
{
    halted_.store(false, std::memory_order_relaxed);
    const Sample& sample = tracker_.at(lived_to_.value_or(base::TimePoint{}));
    const bool pushes = force.motors_on() && tracker_.may_push();
    plant_.set_torque(pushes ? glm::transpose(omni::jacobian_at(sample.hip)) * force.force().value
                             : glm::dvec3{0.0});
}

} // namespace hapnet::device
