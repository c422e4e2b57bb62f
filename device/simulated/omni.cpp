// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/omni.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

// Each hand's workspace is centred where its side of the path is, so that all of it is in reach.
constexpr double workspace_offset_m = 0.025;
// The hand takes this long from its rest to its part.
constexpr double approach_s = 0.8;
constexpr double aside_m = 0.055; // clear of a cube at its start

} // namespace

SimulatedOmni::SimulatedOmni(Task task, const HandImpedance& hand, const OmniPlant& plant)
    : task_{task}, hand_{hand}, plant_{plant}
{}

void SimulatedOmni::on_cue(const Cue& cue)
{
    centre_.x = cue.is_left ? -workspace_offset_m : workspace_offset_m;
    part_ =
        Part{Script{task_, cue}, HandNoise{cue.seed, cue.peer_id}, cue.start, task_ != Task::p1};
    cued_at_.reset();
    rest_ = position_;
}

Intention SimulatedOmni::intention(base::TimePoint now) const
{
    if (!part_ || !cued_at_) return {.target = {rest_}};
    Intention intended = part_->script.at(now);
    if (part_->wavers) {
        intended.target.value.x += part_->noise.at(base::to_seconds(now - part_->start));
    }
    // First aside, then to the part: the straight way might push the cube.
    const double u = base::to_seconds(now - *cued_at_) / approach_s;
    const glm::dvec3 aside{centre_.x < 0.0 ? -aside_m : aside_m, 0.0, rest_.z};
    const glm::dvec3 on_the_way = rest_ + minimum_jerk(2.0 * u) * (aside - rest_);
    intended.target = {on_the_way +
                       minimum_jerk(2.0 * u - 1.0) * (intended.target.value - on_the_way)};
    return intended;
}

Sample SimulatedOmni::read(base::TimePoint now)
{
    if (part_ && !cued_at_) cued_at_ = now;
    if (!simulated_to_ || now - *simulated_to_ > gap_max) simulated_to_ = now;
    // The intention hardly changes within a millisecond: taken once per read.
    const Intention intended = intention(now);
    while (*simulated_to_ + step <= now) {
        advance(intended);
        *simulated_to_ += step;
    }

    const glm::dvec3 reported = quantised(position_);
    if (last_read_ && now > *last_read_) {
        const double elapsed = base::to_seconds(now - *last_read_);
        const double kept = base::exp(-base::two_pi * plant_.velocity_cutoff_hz * elapsed);
        filtered_velocity_ =
            kept * filtered_velocity_ + (1.0 - kept) * (reported - last_reported_) / elapsed;
    }
    last_read_ = now;
    last_reported_ = reported;
    return {{reported}, {filtered_velocity_}, intended.gripping};
}

void SimulatedOmni::apply(base::Force force)
{
    force_ = base::limited(force, plant_.force_max_n).value; // the motors saturate
}

void SimulatedOmni::advance(const Intention& intended)
{
    const double h = base::to_seconds(step);
    for (const int axis : {0, 1, 2}) {
        double& x = position_[axis];
        double& v = velocity_[axis];
        const double pull = force_[axis] - hand_.damping_ns_per_m * v -
                            hand_.stiffness_n_per_m * (x - intended.target.value[axis]);
        // Coulomb friction sticks while the pull is weaker, and otherwise never turns the motion
        // round within a step (Karnopp 1985).
        const double free_v = v + h * pull / hand_.mass_kg;
        const double friction_dv = h * plant_.friction_n / hand_.mass_kg;
        v = std::abs(free_v) <= friction_dv ? 0.0 : free_v - std::copysign(friction_dv, free_v);
        x += h * v;
        stop_at_workspace_end(axis);
    }
}

void SimulatedOmni::stop_at_workspace_end(int axis)
{
    const double low = centre_[axis] - plant_.half_workspace_m[axis];
    const double high = centre_[axis] + plant_.half_workspace_m[axis];
    if (position_[axis] >= low && position_[axis] <= high) return;
    position_[axis] = std::clamp(position_[axis], low, high);
    velocity_[axis] = 0.0;
}

glm::dvec3 SimulatedOmni::quantised(const glm::dvec3& position) const
{
    const auto count = [this](double x) {
        return std::nearbyint(x / plant_.resolution_m) * plant_.resolution_m;
    };
    return {count(position.x), count(position.y), count(position.z)};
}

std::string SimulatedOmni::description() const
{
    return fmt::format("simulated Omni held by a simulated hand ({} kg, {} N s/m, {} N/m)",
                       hand_.mass_kg, hand_.damping_ns_per_m, hand_.stiffness_n_per_m);
}

} // namespace hapnet::device
