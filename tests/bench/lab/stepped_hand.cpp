// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/lab/stepped_hand.hpp"

#include "device/simulated/minimum_jerk.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::bench {

namespace {

// From SimulatedOmni: the place of the workspace, and the time in which the hand reaches its part.
constexpr double workspace_offset_m = 0.025;
constexpr double approach_s = 0.8;

} // namespace

SteppedHand::SteppedHand(const device::Performer& performer, int steps_a_read)
    : performer_{performer},
      steps_a_read_{steps_a_read},
      velocity_{performer.plant.velocity_cutoff_hz}
{
    capabilities_.force_max_n = performer.plant.force_max_n;
    capabilities_.force_continuous_n = performer.plant.force_continuous_n;
    capabilities_.workspace_min.value.x -= workspace_offset_m;
    capabilities_.workspace_max.value.x += workspace_offset_m;
}

void SteppedHand::on_cue(const device::Cue& cue)
{
    centre_.x = cue.is_left ? -workspace_offset_m : workspace_offset_m;
    part_ = Job{device::Script{performer_.task, cue, performer_.options, performer_.person.hand},
                device::HandNoise{cue.seed, cue.peer_id, performer_.person}, cue.start};
    cued_at_.reset();
    rest_ = position_;
}

device::Intention SteppedHand::intention(base::TimePoint now) const
{
    if (!part_ || !cued_at_) return {.target = {rest_}};
    device::Intention intended = part_->script.at(now);
    glm::dvec3& target = intended.target.value;
    if (performer_.task != device::Task::p1) {
        target.x += part_->noise.at(base::to_seconds(now - part_->start)).away_m;
    }
    const double u = base::to_seconds(now - *cued_at_) / approach_s;
    const glm::dvec3 aside{part_->script.aside_x(), 0.0, rest_.z};
    const glm::dvec3 on_the_way = rest_ + device::minimum_jerk(2.0 * u) * (aside - rest_);
    target = on_the_way + device::minimum_jerk(2.0 * u - 1.0) * (target - on_the_way);
    return intended;
}

device::Sample SteppedHand::read(base::TimePoint now)
{
    if (part_ && !cued_at_) cued_at_ = now;
    const device::Intention intended = intention(now);
    if (last_read_) {
        const double seconds = base::to_seconds(now - *last_read_) / steps_a_read_;
        for (int step = 0; step < steps_a_read_; ++step) advance(intended.target, seconds);
    }
    last_read_ = now;
    const double resolution = performer_.plant.resolution_m;
    const auto counted = [&](double x) { return std::nearbyint(x / resolution) * resolution; };
    const base::Position reported{
        {counted(position_.x), counted(position_.y), counted(position_.z)}};
    device::Sample sample;
    sample.hip = reported;
    sample.velocity = velocity_.at(reported, now);
    sample.gripping = intended.gripping;
    sample.sequence = ++reads_;
    return sample;
}

void SteppedHand::apply(const device::GovernedForce& force)
{
    force_ = base::limited(force.force(), performer_.plant.force_max_n).value;
}

void SteppedHand::advance(const base::Position& target, double seconds)
{
    const device::HandImpedance& hand = performer_.person.hand;
    const device::OmniPlant& plant = performer_.plant;
    for (const int axis : {0, 1, 2}) {
        double& x = position_[axis];
        double& v = motion_[axis];
        const double pull = force_[axis] - hand.damping_ns_per_m * v -
                            hand.stiffness_n_per_m * (x - target.value[axis]);
        // Coulomb friction sticks while the pull is weaker. Otherwise it never reverses the motion
        // within a step (Karnopp 1985).
        const double free_v = v + seconds * pull / hand.mass_kg;
        const double friction_dv = seconds * plant.friction_n / hand.mass_kg;
        v = std::abs(free_v) <= friction_dv ? 0.0 : free_v - std::copysign(friction_dv, free_v);
        x += seconds * v;
        const double low = centre_[axis] - plant.half_workspace_m[axis];
        const double high = centre_[axis] + plant.half_workspace_m[axis];
        if (x >= low && x <= high) continue;
        x = std::clamp(x, low, high);
        v = 0.0;
    }
}

} // namespace hapnet::bench
