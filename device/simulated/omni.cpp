// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/omni.hpp"

#include "device/simulated/minimum_jerk.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

// Each hand's workspace is centred where its side of the path is, so that all of it is in reach.
constexpr double workspace_offset_m = 0.025;
// The hand takes this long from its rest to its part.
constexpr double approach_s = 0.8;

} // namespace

SimulatedOmni::SimulatedOmni(const Performer& performer)
    : performer_{performer},
      motion_{performer.person.hand, performer.plant.friction_n},
      reactions_{performer.person},
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
    // Wherever its cue may place it, and the last count.
    const glm::dvec3 reach =
        plant.half_workspace_m + plant.resolution_m + glm::dvec3{workspace_offset_m, 0.0, 0.0};
    capabilities_ = {.workspace_min = {-reach},
                     .workspace_max = {reach},
                     .force_max_n = plant.force_max_n,
                     .force_continuous_n = plant.force_continuous_n,
                     .stiffness_max_n_per_m = 700.0,
                     .damping_max_ns_per_m = 5.0,
                     .resolution_m = plant.resolution_m};
}

void SimulatedOmni::on_cue(const Cue& cue)
{
    centre_.x = cue.is_left ? -workspace_offset_m : workspace_offset_m;
    part_ = Part{Script{performer_.task, cue, performer_.options, performer_.person.hand},
                 HandNoise{cue.seed, cue.peer_id, performer_.person}, cue.start,
                 performer_.task == Task::p1};
    cued_at_.reset();
    rest_ = position();
}

SimulatedOmni::Aim SimulatedOmni::aim(base::TimePoint now) const
{
    if (!part_ || !cued_at_) return {.intention = {.target = {rest_}}};
    Aim aim{.intention = part_->script.at(now)};
    glm::dvec3& target = aim.intention.target.value;
    if (!part_->is_prescribed) {
        const HandNoise::Value noise = part_->noise.at(base::to_seconds(now - part_->start));
        target.x += noise.away_m;
        aim.force_share = noise.force_share;
    }
    // First aside, then to the part: the straight way might push the cube.
    const double u = base::to_seconds(now - *cued_at_) / approach_s;
    if (u >= 1.0) return aim;
    const glm::dvec3 aside{part_->script.aside_x(), 0.0, rest_.z};
    const glm::dvec3 on_the_way = rest_ + minimum_jerk(2.0 * u) * (aside - rest_);
    target = on_the_way + minimum_jerk(2.0 * u - 1.0) * (target - on_the_way);
    return aim;
}

Sample SimulatedOmni::read(base::TimePoint now)
{
    if (halted_.load(std::memory_order_relaxed)) force_ = glm::dvec3{0.0};
    if (part_ && !cued_at_) cued_at_ = now;
    const Aim intended = aim(now);
    const bool lives = simulated_to_ && now - *simulated_to_ <= gap_max;
    if (lives && now > *simulated_to_) advance(intended, now);
    if (!lives) intended_ = intended.intention.target;
    simulated_to_ = now;

    const base::Position reported{quantised(position())};
    Sample sample;
    sample.hip = reported;
    sample.velocity = velocity_.at(reported, now);
    sample.gripping = intended.intention.gripping;
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

void SimulatedOmni::advance(const Aim& intended, base::TimePoint now)
{
    const base::Duration elapsed = now - *simulated_to_;
    base::Position target = intended.intention.target;
    glm::dvec3 force = force_;
    if (part_ && !part_->is_prescribed) {
        const double toward = part_->script.pressing_toward();
        const glm::dvec3 deviation = position() - intended_.value;
        const Reaction reaction = reactions_.to(
            {deviation, -toward * force_.x, intended.intention.pressing_n}, now, elapsed);
        target.value.x += toward * reaction.farther_m;
        force += reaction.force -
                 (intended.force_share * performer_.person.hand.stiffness_n_per_m) * deviation;
    }
    go_on(target, force, elapsed);
    intended_ = target;
}

void SimulatedOmni::go_on(const base::Position& target, const glm::dvec3& force,
                          base::Duration elapsed)
{
    // The intention moves evenly from what it was. Late reads are lived through in short steps.
    const auto steps = (elapsed + step_max - base::Duration{1}) / step_max;
    const double share = 1.0 / static_cast<double>(steps);
    const double seconds = share * base::to_seconds(elapsed);
    motion_.set_step(seconds);
    const glm::dvec3 change = share * (target - intended_).value;
    for (base::Duration::rep i = 0; i < steps; ++i) {
        const glm::dvec3 from = intended_.value + static_cast<double>(i) * change;
        for (const int axis : {0, 1, 2}) {
            HandAxis& hand = axes_[static_cast<std::size_t>(axis)];
            motion_.advance(hand, {force[axis], from[axis], change[axis] / seconds});
            stop_at_workspace_end(axis);
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
        // The nearest whole number, by the rounding of an addition: std::nearbyint is a call.
        constexpr double shift = 6755399441055744.0; // 1.5 * 2^52
        return ((x / performer_.plant.resolution_m + shift) - shift) *
               performer_.plant.resolution_m;
    };
    return {count(position.x), count(position.y), count(position.z)};
}

} // namespace hapnet::device
