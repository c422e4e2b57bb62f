// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/motion.hpp"

namespace hapnet::scene {

namespace {

/// Whether a centre is between the two faces of an obstacle, or just going in.
bool is_between(const Obstacle& obstacle, std::size_t axis, double place, double speed)
{
    const double gap = obstacle.gap(axis, place);
    return gap < 0.0 || (gap == 0.0 && obstacle.side(axis, place) * speed < 0.0);
}

void note_touched_face(BoxMotion& box, const Obstacle& obstacle, std::size_t i)
{
    if (box.position[i] == obstacle.high[i]) box.axes[i].below = &obstacle;
    if (box.position[i] == obstacle.low[i]) box.axes[i].above = &obstacle;
}

void note_touched_faces(BoxMotion& box, const Obstacle& obstacle)
{
    if (obstacle.is_plane) {
        note_touched_face(box, obstacle, obstacle.normal_axis);
        return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (obstacle.gap(i, box.position[i]) != 0.0) continue;
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        if (is_between(obstacle, j, box.position[j], box.velocity[j]) &&
            is_between(obstacle, k, box.position[k], box.velocity[k])) {
            note_touched_face(box, obstacle, i);
        }
    }
}

/// Whether the axis rests on what it touches, pressed on it by its accelerations.
void find_support(AxisMotion& axis, double speed, const Trajectory& trajectory)
{
    if (speed != 0.0 || axis.is_losing_support) return;
    const bool is_idle = trajectory.push == 0.0;
    if (axis.below && (trajectory.push < 0.0 || (is_idle && trajectory.ramp <= 0.0))) {
        axis.support = axis.below;
        axis.load = -trajectory.push;
        axis.load_ramp = -trajectory.ramp;
    } else if (axis.above && (trajectory.push > 0.0 || (is_idle && trajectory.ramp >= 0.0))) {
        axis.support = axis.above;
        axis.load = trajectory.push;
        axis.load_ramp = trajectory.ramp;
    }
}

/// Adds the hands' springs; how many there are on each axis.
std::array<std::size_t, 3> add_springs(BoxMotion& box)
{
    const auto [damping, stiffness] = box.oscillators.spring();
    std::array<std::size_t, 3> count{};
    for (const FaceSpring& spring : box.active_springs()) {
        Trajectory& trajectory = box.trajectories[spring.axis];
        if (spring.phase == SpringPhase::pressing) {
            trajectory.push -= spring.sign * (stiffness * spring.depth + damping * spring.closing);
            trajectory.ramp -= spring.sign * (stiffness * spring.closing);
            ++count[spring.axis];
        } else if (spring.phase == SpringPhase::limited) {
            trajectory.push -=
                spring.sign * (box.hands.force_max_n * box.oscillators.inverse_mass());
        }
    }
    for (const GripSpring& grip : box.active_grips()) {
        for (std::size_t i = 0; i < 3; ++i) {
            box.trajectories[i].push += stiffness * grip.stretch[i] + damping * grip.velocity[i];
            box.trajectories[i].ramp += stiffness * grip.velocity[i];
            ++count[i];
        }
    }
    return count;
}

} // namespace

AxisOscillators::AxisOscillators(const HandDescription& hands, const BodyProperties& body,
                                 double tick)
    : inverse_mass_{1.0 / body.mass}
{
    for (const bool with_drag : {false, true}) {
        for (std::size_t n = 0; n <= hands_max; ++n) {
            const auto springs = static_cast<double>(n);
            const double damping = springs * hands.damping_ns_per_m + (with_drag ? body.drag : 0.0);
            const double stiffness = springs * hands.stiffness_n_per_m;
            propagators_[with_drag ? 1 : 0][n] = Propagator{
                {.damping = damping / body.mass, .stiffness = stiffness / body.mass}, tick};
        }
    }
}

BoxMotion BoxMotion::copy() const
{
    BoxMotion other{hands, oscillators, obstacles};
    other.nearby = nearby;
    other.clearance = clearance;
    other.time_left = time_left;
    other.event_limit_reached = event_limit_reached;
    other.position = position;
    other.velocity = velocity;
    other.axes = axes;
    other.trajectories = trajectories;
    other.dry_friction = dry_friction;
    other.spring_count = spring_count;
    other.grip_count = grip_count;
    other.edge_spring_count = edge_spring_count;
    std::copy_n(springs.begin(), spring_count, other.springs.begin());
    std::copy_n(grips.begin(), grip_count, other.grips.begin());
    std::copy_n(edge_springs.begin(), edge_spring_count, other.edge_springs.begin());
    return other;
}

void set_trajectories(BoxMotion& box)
{
    for (std::size_t i = 0; i < 3; ++i) {
        AxisMotion& axis = box.axes[i];
        axis.below = axis.above = axis.support = nullptr;
        box.trajectories[i] = {nullptr, box.velocity[i], axis.applied_acceleration, 0.0};
    }
    for (const std::uint32_t id : box.nearby) note_touched_faces(box, box.obstacles[id]);
    const auto springs = add_springs(box);

    bool is_on_plane = false;
    for (std::size_t i = 0; i < 3; ++i) {
        AxisMotion& axis = box.axes[i];
        if (axis.below || axis.above) {
            find_support(axis, box.trajectories[i].speed, box.trajectories[i]);
            if (axis.is_dragged()) is_on_plane = true;
        }
        axis.is_losing_support = false;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const AxisMotion& axis = box.axes[i];
        if (axis.is_held() || box.trajectories[i].is_idle()) continue;
        box.trajectories[i].propagator = &box.oscillators.of(springs[i], is_on_plane);
    }
}

void set_bounds(BoxMotion& box)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const Trajectory& trajectory = box.trajectories[i];
        AxisMotion& axis = box.axes[i];
        if (!trajectory.moves()) {
            axis.acceleration = axis.reach = 0.0;
            axis.bounds = {};
            continue;
        }
        axis.acceleration =
            trajectory.push - trajectory.propagator->oscillator.damping * trajectory.speed;
        const double jerk = trajectory.jerk(axis.acceleration, trajectory.speed);
        axis.bounds = bounds(*trajectory.propagator, axis.acceleration, jerk, box.time_left);
        axis.reach = box.time_left *
                     (std::abs(trajectory.speed) + 0.5 * box.time_left * axis.bounds.acceleration);
    }
}

void advance(BoxMotion& box, double time)
{
    PerAxis way{};
    PerAxis way_integral{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Trajectory& trajectory = box.trajectories[i];
        if (!trajectory.moves()) continue;
        const TrajectoryPoint motion = trajectory.after(time);
        const Oscillator& oscillator = trajectory.propagator->oscillator;
        if (oscillator.stiffness > 0.0) { // from the equation of motion, integrated once
            const double forces = time * (trajectory.push + 0.5 * time * trajectory.ramp);
            way_integral[i] = (forces - oscillator.damping * motion.displacement -
                               (motion.speed - trajectory.speed)) /
                              oscillator.stiffness;
        }
        way[i] = motion.displacement;
        box.position[i] += motion.displacement;
        box.velocity[i] = motion.speed;
    }
    const double k = box.hands.stiffness_n_per_m;
    const double c = box.hands.damping_ns_per_m;
    for (FaceSpring& spring : box.active_springs()) {
        const double closed = spring.closing * time + spring.sign * way[spring.axis];
        if (spring.phase == SpringPhase::pressing) {
            const double depths = time * (spring.depth + 0.5 * time * spring.closing) +
                                  spring.sign * way_integral[spring.axis];
            spring.impulse += k * depths + c * closed;
        } else if (spring.phase == SpringPhase::limited) {
            spring.impulse += box.hands.force_max_n * time;
        }
        spring.depth += closed;
    }
    for (GripSpring& grip : box.active_grips()) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double stretched = time * grip.velocity[i] - way[i];
            const double stretches =
                time * (grip.stretch[i] + 0.5 * time * grip.velocity[i]) - way_integral[i];
            grip.impulse[i] += k * stretches + c * stretched;
            grip.stretch[i] += stretched;
        }
    }
    box.time_left -= time;
}

} // namespace hapnet::scene
