// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/events.hpp"

namespace hapnet::scene {

namespace {

using Kind = Event::Kind;

/// `factor` times a spring's depth, plus `level`.
WatchedQuantity watch_depth(const FaceSpring& spring, double factor)
{
    const auto axis = spring.axis;
    WatchedQuantity watch{.level = factor * spring.depth, .slope = factor * spring.closing};
    watch.displacement_weight[axis] = factor * spring.sign;
    return watch;
}

/// `factor` times what a spring's force is without limits, plus `level`.
WatchedQuantity watch_tension(const BoxMotion& box, const FaceSpring& spring, double factor,
                              double level)
{
    const double k = factor * box.hands.stiffness_n_per_m;
    const double c = factor * box.hands.damping_ns_per_m;
    const auto axis = spring.axis;
    WatchedQuantity watch{.level = level + k * spring.depth + c * spring.closing,
                          .slope = k * spring.closing};
    watch.displacement_weight[axis] = k * spring.sign;
    watch.speed_weight[axis] = c * spring.sign;
    return watch;
}

/// Whether a spring presses for the whole `time`, as most do.
bool keeps_acting(const BoxMotion& box, const FaceSpring& spring, double time)
{
    if (spring.phase != SpringPhase::pressing) return false;
    const HandDescription& hands = box.hands;
    const AxisMotion& axis = box.axes[spring.axis];
    const double closing = spring.closing_at(box.velocity[spring.axis]);
    const double k = hands.stiffness_n_per_m;
    const double c = hands.damping_ns_per_m;
    const double tension = k * spring.depth + c * closing;
    const double rate = std::abs(k * closing + c * spring.sign * axis.acceleration);
    const double bend = k * axis.bounds.acceleration + c * axis.bounds.jerk;
    const double change = time * (rate + 0.5 * time * bend);
    return tension >= change && hands.force_max_n - tension >= change;
}

struct SpringEventFinder {
    const BoxMotion& box;
    std::uint32_t index;
    Event& first;

    void expect(const WatchedQuantity& watch, SpringPhase next) const
    {
        const auto time = first_root(watch, box.trajectories, 0.0, first.time);
        if (!time) return;
        first = {.time = *time, .kind = Kind::spring, .spring = index, .phase = next};
    }

    void find() const
    {
        const FaceSpring& spring = box.springs[index];
        const HandDescription& hands = box.hands;
        const AxisMotion& axis = box.axes[spring.axis];
        const double closing = spring.closing_at(box.velocity[spring.axis]);
        const double k = hands.stiffness_n_per_m;
        const double c = hands.damping_ns_per_m;
        const double left = first.time;
        if (spring.phase == SpringPhase::apart || spring.phase == SpringPhase::slack) {
            const double away = spring.phase == SpringPhase::apart ? -1.0 : 1.0;
            if (!stays_positive(away * spring.depth, away * closing, axis.bounds.acceleration,
                                left)) {
                expect(watch_depth(spring, away), spring.phase == SpringPhase::apart
                                                      ? SpringPhase::pressing
                                                      : SpringPhase::apart);
            }
            if (spring.phase == SpringPhase::apart) return;
        }
        const double tension = k * spring.depth + c * closing;
        const double rate = k * closing + c * spring.sign * axis.acceleration;
        const double bend = k * axis.bounds.acceleration + c * axis.bounds.jerk;
        if (spring.phase == SpringPhase::slack) {
            if (!stays_positive(-tension, -rate, bend, left)) {
                expect(watch_tension(box, spring, -1.0, 0.0), SpringPhase::pressing);
            }
            return;
        }
        const double room = hands.force_max_n - tension;
        if (spring.phase == SpringPhase::limited) {
            if (!stays_positive(-room, rate, bend, left)) {
                expect(watch_tension(box, spring, 1.0, -hands.force_max_n), SpringPhase::pressing);
            }
            return;
        }
        if (!stays_positive(tension, rate, bend, left)) {
            expect(watch_tension(box, spring, 1.0, 0.0),
                   c > 0.0 ? SpringPhase::slack : SpringPhase::apart);
        }
        if (!stays_positive(room, -rate, bend, left)) {
            expect(watch_tension(box, spring, -1.0, hands.force_max_n), SpringPhase::limited);
        }
    }
};

/// `side` times how far the centre is from a face.
WatchedQuantity watch_gap(const BoxMotion& box, std::size_t axis, double side, double face)
{
    WatchedQuantity watch{.level = side * (box.position[axis] - face)};
    watch.displacement_weight[axis] = side;
    return watch;
}

/// Whether the box cannot come to an obstacle in what is left of the tick: one axis keeps it away.
bool separates(const BoxMotion& box, const Obstacle& obstacle, std::size_t i)
{
    const double gap = obstacle.gap(i, box.position[i]);
    const double reach = box.axes[i].reach;
    return gap > reach || (reach == 0.0 && gap >= 0.0);
}

bool is_out_of_reach(const BoxMotion& box, const Obstacle& obstacle)
{
    if (obstacle.is_plane) return separates(box, obstacle, obstacle.normal_axis);
    return separates(box, obstacle, 0) || separates(box, obstacle, 1) ||
           separates(box, obstacle, 2);
}

constexpr std::size_t nothing = 3;

/// The axis that keeps a box away from an obstacle at some moment: the one with the widest gap.
std::size_t separating_axis(const BoxMotion& box, const Obstacle& obstacle, double time,
                            std::size_t but)
{
    std::size_t widest = nothing;
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (i == but) continue;
        const TrajectoryPoint motion = box.trajectories[i].after(time);
        const double place = box.position[i] + motion.displacement;
        const double gap = obstacle.gap(i, place);
        const double speed = box.trajectories[i].moves() ? motion.speed : 0.0;
        if (gap < 0.0 || (gap == 0.0 && but != nothing && obstacle.side(i, place) * speed < 0.0)) {
            continue;
        }
        if (widest == nothing || gap > most) {
            widest = i;
            most = gap;
        }
    }
    return widest;
}

/// The box touches an obstacle when the last of the three axes has closed its gap.
void find_impact(const BoxMotion& box, const Obstacle& obstacle, Event& first)
{
    constexpr int rounds_max = 8; // an axis may open its gap again while another closes
    std::size_t axis = separating_axis(box, obstacle, 0.0, nothing);
    double time = 0.0;
    for (int turn = 0; turn < rounds_max && axis != nothing; ++turn) {
        const double place = box.position[axis] + box.trajectories[axis].after(time).displacement;
        const double side = obstacle.side(axis, place);
        const double face = obstacle.face(axis, side);
        const auto root =
            first_root(watch_gap(box, axis, side, face), box.trajectories, time, first.time);
        if (!root) return;
        time = *root;
        const std::size_t other = separating_axis(box, obstacle, time, axis);
        if (other == nothing) {
            first = {.time = time, .kind = Kind::impact, .axis = axis};
            first.face = face;
            first.side = side;
            first.obstacle = &obstacle;
            return;
        }
        axis = other;
    }
}

/// An axis loses its support when other forces lift it off, or behind its edge.
void find_loss_of_support(const BoxMotion& box, std::size_t i, Event& first)
{
    const AxisMotion& axis = box.axes[i];
    if (axis.load + axis.load_ramp * first.time < 0.0) {
        first = {.time = axis.load / -axis.load_ramp, .kind = Kind::unloading, .axis = i};
    }
    if (axis.support->is_plane) return;
    for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
        if (-axis.support->gap(j, box.position[j]) > box.axes[j].reach) continue;
        for (const double side : {1.0, -1.0}) {
            const double face = axis.support->face(j, side);
            const auto time =
                first_root(watch_gap(box, j, -side, face), box.trajectories, 0.0, first.time);
            if (!time) continue;
            first = {.time = *time, .kind = Kind::edge, .axis = j};
            first.face = face;
        }
    }
}

/// Stops the box or sends it back. A bounce that would be over before a tick has passed is left
/// out: otherwise a box would come to rest by endlessly many.
void handle_impact(BoxMotion& box, const Event& event, double tick)
{
    const std::size_t i = event.axis;
    const Trajectory& trajectory = box.trajectories[i];
    const double closing = -event.side * box.velocity[i];
    const double acceleration = trajectory.acceleration(event.time, trajectory.after(event.time));
    const double back =
        box.event_limit_reached ? 0.0 : event.obstacle->material.restitution * closing;
    const double pressing = -event.side * acceleration;
    const bool is_over = 2.0 * back <= pressing * tick;
    box.velocity[i] = is_over ? 0.0 : event.side * back;
    box.axes[i].is_stopped = box.event_limit_reached;
}

} // namespace

bool is_uneventful(const BoxMotion& box)
{
    if (!box.event_limit_reached) {
        for (const FaceSpring& spring : box.active_springs()) {
            if (!keeps_acting(box, spring, box.time_left)) return false;
        }
        for (const AxisMotion& axis : box.axes) {
            if (!axis.support) continue;
            if (!axis.support->is_plane) return false;
            if (axis.load + axis.load_ramp * box.time_left < 0.0) return false;
        }
    }
    for (const std::uint32_t id : box.nearby) {
        if (!is_out_of_reach(box, box.obstacles[id])) return false;
    }
    return true;
}

void find_event(const BoxMotion& box, Event& first)
{
    if (!box.event_limit_reached) {
        for (std::uint32_t i = 0; i < box.spring_count; ++i) {
            if (keeps_acting(box, box.springs[i], first.time)) continue;
            SpringEventFinder{box, i, first}.find();
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (box.axes[i].support) find_loss_of_support(box, i, first);
        }
    }
    for (const std::uint32_t id : box.nearby) {
        const Obstacle& obstacle = box.obstacles[id];
        if (!is_out_of_reach(box, obstacle)) find_impact(box, obstacle, first);
    }
}

void handle_event(BoxMotion& box, const Event& event, double tick)
{
    const HandDescription& hands = box.hands;
    switch (event.kind) {
    case Kind::none: break;
    case Kind::spring: {
        FaceSpring& spring = box.springs[event.spring];
        const bool touches = spring.phase == SpringPhase::apart;
        spring.phase = event.phase;
        const double speed = box.velocity[spring.axis];
        if (touches && spring.tension(hands, speed) >= hands.force_max_n) {
            spring.phase = SpringPhase::limited;
        }
        break;
    }
    case Kind::impact:
        box.position[event.axis] = event.face;
        handle_impact(box, event, tick);
        break;
    case Kind::unloading: box.axes[event.axis].is_losing_support = true; break;
    case Kind::edge: box.position[event.axis] = event.face; break;
    case Kind::stop:
        for (std::size_t i = 0; i < 3; ++i) {
            if (box.trajectories[i].moves()) box.velocity[i] = 0.0;
        }
        break;
    case Kind::slip: box.dry_friction.starts_slipping = true; break;
    }
}

} // namespace hapnet::scene
