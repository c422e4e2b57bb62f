// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/friction.hpp"

#include "scene/one_box/coupled.hpp"

namespace hapnet::scene {

namespace {

using State = DryFriction::State;

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

/// Returns the motion of the axes that only friction can hold.
Tangential tangential(const BoxMotion& box)
{
    Tangential found;
    for (std::size_t i = 0; i < 3; ++i) {
        const AxisMotion& axis = box.axes[i];
        if (axis.is_held()) continue;
        found.velocity[i] = box.velocity[i];
        found.push[i] = box.trajectories[i].push;
        found.ramp[i] = box.trajectories[i].ramp;
        found.all[found.count++] = i;
    }
    return found;
}

/// True if the direction cannot change: only one axis takes part, or force and speed have the same
/// direction, the force is steady, and both axes respond equally.
bool is_straight(const BoxMotion& box, const Tangential& free)
{
    if (free.count < 2) return true;
    const std::size_t i = free.all[0];
    const std::size_t j = free.all[1];
    for (const std::size_t k : {i, j}) {
        if (free.velocity[k] == 0.0 && free.push[k] == 0.0 && free.ramp[k] == 0.0) return true;
    }
    if (box.trajectories[i].propagator != box.trajectories[j].propagator) return false;
    if (free.ramp[i] != 0.0 || free.ramp[j] != 0.0) return false;
    constexpr double rounding = 1e-13;
    const double cross = free.velocity[i] * free.push[j] - free.velocity[j] * free.push[i];
    return cross * cross <=
           rounding * rounding * dot(free.velocity, free.velocity) * dot(free.push, free.push);
}

void oppose(BoxMotion& box, const Tangential& free, const PerAxis& direction)
{
    for (const std::size_t i : free.axes()) {
        box.trajectories[i].push = free.push[i] - box.dry_friction.limit * direction[i];
        box.trajectories[i].ramp = free.ramp[i] - box.dry_friction.limit_ramp * direction[i];
    }
}

/// Returns the direction in the middle of the remaining tick, found with the direction at its
/// start.
PerAxis direction_halfway(BoxMotion& box, const Tangential& free, const PerAxis& direction)
{
    oppose(box, free, direction);
    PerAxis middle{};
    for (const std::size_t i : free.axes()) {
        middle[i] = box.trajectories[i].after(0.5 * box.time_left).speed;
    }
    if (!(dot(middle, direction) > 0.0)) return direction;
    return unit(middle);
}

/// Sums up the limits of friction from the loads on the supports. Returns true if there is any
/// friction.
bool load(BoxMotion& box)
{
    DryFriction& dry_friction = box.dry_friction;
    dry_friction.limit = dry_friction.limit_ramp = 0.0;
    for (const AxisMotion& axis : box.axes) {
        if (!axis.support) continue;
        dry_friction.limit += axis.support->material.friction * axis.load;
        dry_friction.limit_ramp += axis.support->material.friction * axis.load_ramp;
    }
    return dry_friction.limit > 0.0 || dry_friction.limit_ramp > 0.0;
}

/// Finds the load on the supports, and the direction of sliding, in the middle of the rest of the
/// tick. It is needed where slanted springs couple both to all motion.
void set_friction_halfway(BoxMotion& box, const Tangential& free)
{
    DryFriction& dry_friction = box.dry_friction;
    dry_friction.limit_ramp = 0.0;
    oppose(box, free, dry_friction.direction);
    find_modes(box);
    set_modes(box);
    const double halfway = 0.5 * box.time_left;
    std::array<TrajectoryPoint, 3> middle{};
    PerAxis velocity{};
    for (std::size_t i = 0; i < 3; ++i) {
        middle[i] = motion_after(box, i, halfway);
        velocity[i] = middle[i].speed;
    }
    dry_friction.limit = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!box.axes[i].support) continue;
        const WatchedQuantity watch = watch_load(box, i);
        double load = watch.level + watch.slope * halfway;
        for (std::size_t j = 0; j < 3; ++j) {
            load += watch.displacement_weight[j] * middle[j].displacement +
                    watch.speed_weight[j] * middle[j].speed;
        }
        dry_friction.limit += box.axes[i].support->material.friction * std::max(load, 0.0);
    }
    if (dot(velocity, dry_friction.direction) > 0.0) dry_friction.direction = unit(velocity);
    oppose(box, free, dry_friction.direction);
}

} // namespace

void add_friction(BoxMotion& box)
{
    DryFriction& dry_friction = box.dry_friction;
    const bool was_starting_to_slip = dry_friction.starts_slipping;
    dry_friction.state = State::none;
    dry_friction.starts_slipping = false;
    if (!load(box)) return;
    const Tangential free = tangential(box);
    if (free.count == 0) return;

    const double speed_squared = dot(free.velocity, free.velocity);
    const double push_squared = dot(free.push, free.push);
    if (speed_squared == 0.0) {
        const bool holds =
            push_squared <= dry_friction.limit * dry_friction.limit && !was_starting_to_slip;
        if (holds || push_squared == 0.0) {
            dry_friction.state = State::stuck;
            for (const std::size_t i : free.axes()) {
                box.trajectories[i].propagator = nullptr;
            }
            return;
        }
        dry_friction.starts_slipping = true;
        dry_friction.direction = unit(free.push);
    } else {
        dry_friction.direction = unit(free.velocity);
    }
    dry_friction.state = State::sliding;
    if (box.is_coupled) {
        set_friction_halfway(box, free);
        return;
    }
    if (!is_straight(box, free))
        dry_friction.direction = direction_halfway(box, free, dry_friction.direction);
    oppose(box, free, dry_friction.direction);
}

namespace {

/// Finds the time when limit(t)^2 - |push(t)|^2 falls to 0. Limit and push are linear in time.
void find_slip(const BoxMotion& box, Event& first)
{
    const DryFriction& dry_friction = box.dry_friction;
    const Tangential free = tangential(box);
    const double level =
        std::max(dry_friction.limit * dry_friction.limit - dot(free.push, free.push), 0.0);
    const double half_slope =
        dry_friction.limit * dry_friction.limit_ramp - dot(free.push, free.ramp);
    const double bend =
        dry_friction.limit_ramp * dry_friction.limit_ramp - dot(free.ramp, free.ramp);
    if (level == 0.0 && half_slope >= 0.0 && bend >= 0.0) return;
    const double discriminant = half_slope * half_slope - bend * level;
    if (discriminant < 0.0) return;
    const double rate = -half_slope + std::sqrt(discriminant);
    if (rate <= 0.0 || level >= rate * first.time) return;
    first = {.time = level / rate, .kind = Event::Kind::slip};
}

void find_stop(const BoxMotion& box, Event& first)
{
    const PerAxis& direction = box.dry_friction.direction;
    WatchedQuantity watch{.leaves_zero = box.dry_friction.starts_slipping};
    double speed = 0.0;
    double rate = 0.0;
    double bend = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!box.trajectories[i].moves()) continue;
        watch.speed_weight[i] = direction[i];
        speed += direction[i] * box.velocity[i];
        rate += direction[i] * box.axes[i].acceleration;
        bend += std::abs(direction[i]) * box.axes[i].bounds.jerk;
    }
    if (stays_positive(speed, rate, bend, first.time)) return;
    expect(box, watch, 0.0, first, {.kind = Event::Kind::stop});
}

} // namespace

void find_friction_event(const BoxMotion& box, Event& first)
{
    if (box.dry_friction.state == State::stuck) find_slip(box, first);
    if (box.dry_friction.state == State::sliding) find_stop(box, first);
}

} // namespace hapnet::scene
