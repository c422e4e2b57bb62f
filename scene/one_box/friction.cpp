// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/events.hpp"

namespace hapnet::scene {

// Coulomb's law with a circular cone. While the box slides straight on, friction is a steady force
// (or grows steadily with what presses on the carrier), and the courses are exact. Where other
// forces turn its way, the direction in the middle of the stretch is taken: second order.

namespace {

using State = Rubbing::State;

PerAxis unit(const PerAxis& a)
{
    const double length = std::sqrt(dot(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
}

struct Tangential {
    PerAxis velocity{};
    PerAxis push{};
    PerAxis ramp{};
    std::array<std::size_t, 3> all{};
    std::size_t count = 0;

    [[nodiscard]] std::span<const std::size_t> axes() const { return {all.data(), count}; }
};

/// What the axes do that nothing but friction holds.
Tangential tangential(const Slide& slide)
{
    Tangential found;
    for (std::size_t i = 0; i < 3; ++i) {
        const SlideAxis& axis = slide.axes[i];
        if (axis.is_held()) continue;
        found.velocity[i] = slide.velocity[i];
        found.push[i] = slide.trajectories[i].push;
        found.ramp[i] = slide.trajectories[i].ramp;
        found.all[found.count++] = i;
    }
    return found;
}

/// Whether the direction cannot change: only one axis takes part, or force, speed and what answers
/// them are alike in both.
bool is_straight(const Slide& slide, const Tangential& free)
{
    if (free.count < 2) return true;
    const std::size_t i = free.all[0];
    const std::size_t j = free.all[1];
    for (const std::size_t k : {i, j}) {
        if (free.velocity[k] == 0.0 && free.push[k] == 0.0 && free.ramp[k] == 0.0) return true;
    }
    if (slide.trajectories[i].propagator != slide.trajectories[j].propagator) return false;
    if (free.ramp[i] != 0.0 || free.ramp[j] != 0.0) return false;
    constexpr double rounding = 1e-13;
    const double cross = free.velocity[i] * free.push[j] - free.velocity[j] * free.push[i];
    return cross * cross <=
           rounding * rounding * dot(free.velocity, free.velocity) * dot(free.push, free.push);
}

void oppose(Slide& slide, const Tangential& free, const PerAxis& direction)
{
    for (const std::size_t i : free.axes()) {
        slide.trajectories[i].push = free.push[i] - slide.rubbing.limit * direction[i];
        slide.trajectories[i].ramp = free.ramp[i] - slide.rubbing.limit_ramp * direction[i];
    }
}

/// The direction in the middle of what is left of the tick, found with the one at its start.
PerAxis rotated(Slide& slide, const Tangential& free, const PerAxis& direction)
{
    oppose(slide, free, direction);
    PerAxis middle{};
    for (const std::size_t i : free.axes()) {
        middle[i] = slide.trajectories[i].after(0.5 * slide.left).speed;
    }
    if (!(dot(middle, direction) > 0.0)) return direction;
    return unit(middle);
}

/// Adds up what presses on the carriers; whether there is any friction.
bool load(Slide& slide)
{
    Rubbing& rubbing = slide.rubbing;
    rubbing.limit = rubbing.limit_ramp = 0.0;
    for (const SlideAxis& axis : slide.axes) {
        if (!axis.carrier) continue;
        rubbing.limit += axis.carrier->friction * axis.load;
        rubbing.limit_ramp += axis.carrier->friction * axis.load_ramp;
    }
    return rubbing.limit > 0.0 || rubbing.limit_ramp > 0.0;
}

} // namespace

void with_friction(Slide& slide)
{
    Rubbing& rubbing = slide.rubbing;
    const bool has_slipped = rubbing.slips;
    rubbing.state = State::none;
    rubbing.slips = false;
    if (!load(slide)) return;
    const Tangential free = tangential(slide);
    if (free.count == 0) return;

    const double speed_squared = dot(free.velocity, free.velocity);
    const double push_squared = dot(free.push, free.push);
    if (speed_squared == 0.0) {
        const bool holds = push_squared <= rubbing.limit * rubbing.limit && !has_slipped;
        if (holds || push_squared == 0.0) {
            rubbing.state = State::stuck;
            for (const std::size_t i : free.axes()) {
                slide.trajectories[i].propagator = nullptr;
            }
            return;
        }
        rubbing.slips = true;
        rubbing.direction = unit(free.push);
    } else {
        rubbing.direction = unit(free.velocity);
    }
    rubbing.state = State::sliding;
    if (!is_straight(slide, free)) rubbing.direction = rotated(slide, free, rubbing.direction);
    oppose(slide, free, rubbing.direction);
}

namespace {

/// When limit(t)^2 - |push(t)|^2 falls to 0, all of them linear.
void look_for_slip(const Slide& slide, SlideEvent& first)
{
    const Rubbing& rubbing = slide.rubbing;
    const Tangential free = tangential(slide);
    const double level = std::max(rubbing.limit * rubbing.limit - dot(free.push, free.push), 0.0);
    const double half_slope = rubbing.limit * rubbing.limit_ramp - dot(free.push, free.ramp);
    const double bend = rubbing.limit_ramp * rubbing.limit_ramp - dot(free.ramp, free.ramp);
    if (level == 0.0 && half_slope >= 0.0 && bend >= 0.0) return;
    const double discriminant = half_slope * half_slope - bend * level;
    if (discriminant < 0.0) return;
    const double rate = -half_slope + std::sqrt(discriminant);
    if (rate <= 0.0 || level >= rate * first.time) return;
    first = {.time = level / rate, .kind = SlideEvent::Kind::slip};
}

void look_for_stop(const Slide& slide, SlideEvent& first)
{
    const PerAxis& direction = slide.rubbing.direction;
    WatchedQuantity watch{.leaves_zero = slide.rubbing.slips};
    double speed = 0.0;
    double rate = 0.0;
    double bend = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!slide.trajectories[i].moves()) continue;
        watch.speed_weight[i] = direction[i];
        speed += direction[i] * slide.velocity[i];
        rate += direction[i] * slide.axes[i].acceleration;
        bend += std::abs(direction[i]) * slide.axes[i].most.jerk;
    }
    if (stays_positive(speed, rate, bend, first.time)) return;
    const auto time = first_root(watch, slide.trajectories, 0.0, first.time);
    if (time) first = {.time = *time, .kind = SlideEvent::Kind::stop};
}

} // namespace

void friction_event(const Slide& slide, SlideEvent& first)
{
    if (slide.calm) return;
    if (slide.rubbing.state == State::stuck) look_for_slip(slide, first);
    if (slide.rubbing.state == State::sliding) look_for_stop(slide, first);
}

} // namespace hapnet::scene
