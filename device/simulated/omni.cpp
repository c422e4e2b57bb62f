// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/omni.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
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
    : task_{task}, hand_{hand}, plant_{plant}, motion_{hand, plant.friction_n}
{}

void SimulatedOmni::on_cue(const Cue& cue)
{
    centre_.x = cue.is_left ? -workspace_offset_m : workspace_offset_m;
    part_ =
        Part{Script{task_, cue}, HandNoise{cue.seed, cue.peer_id}, cue.start, task_ != Task::p1};
    cued_at_.reset();
    rest_ = position();
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
    const Intention intended = intention(now);
    const bool lives = simulated_to_ && now - *simulated_to_ <= gap_max;
    if (lives && now > *simulated_to_) advance(intended.target, now - *simulated_to_);
    simulated_to_ = now;
    intended_ = intended.target;

    const glm::dvec3 reported = quantised(position());
    if (last_read_ && now > *last_read_) filter(reported, now - *last_read_);
    last_read_ = now;
    last_reported_ = reported;
    return {{reported}, {filtered_velocity_}, intended.gripping};
}

void SimulatedOmni::filter(const glm::dvec3& reported, base::Duration elapsed)
{
    if (elapsed != filtered_over_) {
        filtered_over_ = elapsed;
        const double seconds = base::to_seconds(elapsed);
        filter_keeps_ = base::exp(-base::two_pi * plant_.velocity_cutoff_hz * seconds);
        filter_gain_ = (1.0 - filter_keeps_) / seconds;
    }
    filtered_velocity_ =
        filter_keeps_ * filtered_velocity_ + filter_gain_ * (reported - last_reported_);
}

void SimulatedOmni::apply(base::Force force)
{
    force_ = base::limited(force, plant_.force_max_n).value; // the motors saturate
}

void SimulatedOmni::advance(const base::Position& target, base::Duration elapsed)
{
    // The intention moves evenly from what it was. Late reads are lived through in short steps.
    const auto steps = (elapsed + step_max - base::Duration{1}) / step_max;
    const double seconds = base::to_seconds(elapsed) / static_cast<double>(steps);
    motion_.set_step(seconds);
    const glm::dvec3 change = (target - intended_).value / static_cast<double>(steps);
    for (base::Duration::rep i = 0; i < steps; ++i) {
        const glm::dvec3 from = intended_.value + static_cast<double>(i) * change;
        for (const int axis : {0, 1, 2}) {
            HandAxis& hand = axes_[static_cast<std::size_t>(axis)];
            motion_.advance(hand, {force_[axis], from[axis], change[axis] / seconds});
            stop_at_workspace_end(axis);
        }
    }
}

void SimulatedOmni::stop_at_workspace_end(int axis)
{
    HandAxis& hand = axes_[static_cast<std::size_t>(axis)];
    const double low = centre_[axis] - plant_.half_workspace_m[axis];
    const double high = centre_[axis] + plant_.half_workspace_m[axis];
    if (hand.position_m >= low && hand.position_m <= high) return;
    hand.position_m = std::clamp(hand.position_m, low, high);
    hand.velocity_m_per_s = 0.0;
}

glm::dvec3 SimulatedOmni::position() const
{
    return {axes_[0].position_m, axes_[1].position_m, axes_[2].position_m};
}

glm::dvec3 SimulatedOmni::quantised(const glm::dvec3& position) const
{
    const auto count = [this](double x) {
        // The nearest whole number, by the rounding of an addition: std::nearbyint is a call.
        constexpr double shift = 6755399441055744.0; // 1.5 * 2^52
        return ((x / plant_.resolution_m + shift) - shift) * plant_.resolution_m;
    };
    return {count(position.x), count(position.y), count(position.z)};
}

std::string SimulatedOmni::description() const
{
    return fmt::format("simulated Omni held by a simulated hand ({} kg, {} N s/m, {} N/m)",
                       hand_.mass_kg, hand_.damping_ns_per_m, hand_.stiffness_n_per_m);
}

} // namespace hapnet::device
