// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/omni.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <numbers>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

// The offset of each hand's workspace toward its side of the path, so that the whole path is in
// reach.
constexpr double workspace_offset_m = 0.025;

} // namespace

SimulatedOmni::SimulatedOmni(const Performer& performer)
    : performer_{performer},
      motion_{performer.person.hand, performer.plant.friction_n},
      person_{{performer.task, performer.options, performer.person, performer.way}},
      velocity_{performer.plant.velocity_cutoff_hz}
{
    const HandImpedance& hand = performer.person.hand;
    identity_ = {.backend = "sim",
                 .serial = "",
                 .model = "simulated Omni",
                 .note = fmt::format("held by a simulated hand, {}: {} kg, {} N s/m, {} N/m",
                                     performer.person.name, hand.mass_kg, hand.damping_ns_per_m,
                                     hand.stiffness_n_per_m)};
    const OmniPlant& plant = performer.plant;
    // The reach includes the workspace for every offset that its cue may set, and the last count.
    const glm::dvec3 reach =
        plant.half_workspace_m + plant.resolution_m + glm::dvec3{workspace_offset_m, 0.0, 0.0};
    capabilities_ = {.workspace_min = {-reach},
                     .workspace_max = {reach},
                     .force_max_n = plant.force_max_n,
                     .force_continuous_n = plant.force_continuous_n,
                     .stiffness_max_n_per_m = 700.0,
                     .damping_max_ns_per_m = 5.0,
                     .resolution_m = plant.resolution_m,
                     .friction_n = plant.stated_friction_n.value_or(plant.friction_n)};
}

void SimulatedOmni::on_cue(const Cue& cue)
{
    centre_.x = cue.is_left ? -workspace_offset_m : workspace_offset_m;
    person_.on_cue(cue, position());
}

Sample SimulatedOmni::read(base::TimePoint now)
{
    if (halted_.load(std::memory_order_relaxed)) force_ = glm::dvec3{0.0};
    const Person::Aim aim = person_.aim(now);
    const bool lives = simulated_to_ && now - *simulated_to_ <= gap_max;
    if (lives && now > *simulated_to_) advance(aim, now);
    if (!lives) intended_ = aim.intention.target;
    simulated_to_ = now;

    const base::Position reported{quantised(position())};
    Sample sample;
    sample.hip = reported;
    sample.velocity = velocity_.at(reported, now);
    sample.gripping = aim.intention.gripping;
    sample.buttons = sample.gripping ? 1 : 0;
    sample.sequence = ++reads_;
    return sample;
}

void SimulatedOmni::apply(const GovernedForce& force)
{
    halted_.store(false, std::memory_order_relaxed);
    // The motors saturate.
    force_ = base::limited(force.force(), performer_.plant.force_max_n).value;
}

void SimulatedOmni::advance(const Person::Aim& aim, base::TimePoint now)
{
    const base::Duration elapsed = now - *simulated_to_;
    const glm::dvec3 force = force_at_grip(elapsed);
    const Person::Effort effort =
        person_.effort(aim, {position() - intended_.value, force}, now, elapsed);
    go_on(effort.target, force + effort.force, elapsed);
    intended_ = effort.target;
}

/// Returns the force at the grip after this time.
const glm::dvec3& SimulatedOmni::force_at_grip(base::Duration elapsed)
{
    const auto& cutoff_hz = performer_.plant.force_bandwidth_hz;
    if (!cutoff_hz) return force_;
    const double share =
        1.0 - base::exp(-2.0 * std::numbers::pi * *cutoff_hz * base::to_seconds(elapsed));
    at_grip_ += share * (force_ - at_grip_);
    return at_grip_;
}

void SimulatedOmni::go_on(const base::Position& target, const glm::dvec3& force,
                          base::Duration elapsed)
{
    // The intention moves linearly from its previous value. The time before a late read is
    // simulated in short steps.
    const auto steps = (elapsed + step_max - base::Duration{1}) / step_max;
    const double share = 1.0 / static_cast<double>(steps);
    const double seconds = share * base::to_seconds(elapsed);
    motion_.set_step(seconds);
    // Axes are arrays: an index into a glm vector costs a branch.
    using Axes = std::array<double, 3>;
    const auto per_axis = [](const glm::dvec3& v) { return Axes{v.x, v.y, v.z}; };
    const Axes begin = per_axis(intended_.value);
    const Axes change = per_axis(share * (target - intended_).value);
    const Axes pushed = per_axis(force);
    for (base::Duration::rep i = 0; i < steps; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double from = begin[axis] + static_cast<double>(i) * change[axis];
            motion_.advance(axes_[axis], {pushed[axis], from, change[axis] / seconds});
            stop_at_workspace_end(static_cast<int>(axis));
        }
    }
}

void SimulatedOmni::stop_at_workspace_end(int axis)
{
    HandAxis& hand = axes_[static_cast<std::size_t>(axis)];
    const double low = centre_[axis] - performer_.plant.half_workspace_m[axis];
    const double high = centre_[axis] + performer_.plant.half_workspace_m[axis];
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
        // The addition rounds to the nearest whole number. std::nearbyint would be a function call.
        constexpr double shift = 6755399441055744.0; // 1.5 * 2^52
        return ((x / performer_.plant.resolution_m + shift) - shift) *
               performer_.plant.resolution_m;
    };
    return {count(position.x), count(position.y), count(position.z)};
}

} // namespace hapnet::device
