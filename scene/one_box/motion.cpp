// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/motion.hpp"

#include "scene/one_box/coupled.hpp"

namespace hapnet::scene {

namespace {

/// True if a centre is between the two faces of an obstacle, or about to enter.
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

/// Sets the support and the load of an axis at an obstacle, if accelerations press it on the
/// obstacle.
void find_support(AxisMotion& axis, double speed, double push, double ramp)
{
    if (speed != 0.0 || axis.is_losing_support) return;
    const bool is_idle = push == 0.0;
    if (axis.below && (push < 0.0 || (is_idle && ramp <= 0.0))) {
        axis.support = axis.below;
        axis.load = -push;
        axis.load_ramp = -ramp;
    } else if (axis.above && (push > 0.0 || (is_idle && ramp >= 0.0))) {
        axis.support = axis.above;
        axis.load = push;
        axis.load_ramp = ramp;
    }
}

/// Finds the supports of all axes. Returns true if one of them is a plane whose drag acts. `push`
/// returns the acceleration along an axis.
template <typename Push>
bool find_supports(BoxMotion& box, const Push& push)
{
    bool is_on_plane = false;
    for (std::size_t i = 0; i < 3; ++i) {
        AxisMotion& axis = box.axes[i];
        if (axis.below || axis.above) {
            find_support(axis, box.trajectories[i].speed, push(i), box.trajectories[i].ramp);
            if (axis.is_dragged()) is_on_plane = true;
        }
        axis.is_losing_support = false;
    }
    return is_on_plane;
}

/// Adds the hands' springs. Returns how many there are on each axis.
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

/// Adds the springs at edges and corners. Returns true if one presses. `damped` gets the force that
/// a damper adds along an axis that does not move, because the others do.
bool add_slanted_springs(BoxMotion& box, PerAxis& damped)
{
    const auto [damping, stiffness] = box.oscillators.spring();
    bool any = false;
    const auto add = [&](const SlantedSpring& spring, double push, double ramp) {
        for (std::size_t i = 0; i < 3; ++i) {
            box.trajectories[i].push -= push * spring.normal[i];
            box.trajectories[i].ramp -= ramp * spring.normal[i];
        }
    };
    for (const SlantedSpring& spring : box.active_slanted()) {
        if (spring.phase == SpringPhase::pressing) {
            any = true;
            add(spring, stiffness * spring.depth + damping * spring.closing,
                stiffness * spring.closing);
            spring.add_along(damped, -damping * spring.along(box.velocity));
        } else if (spring.phase == SpringPhase::limited) {
            add(spring, box.hands.force_max_n * box.oscillators.inverse_mass(), 0.0);
        }
    }
    return any;
}

/// The outcome of a trajectory: the displacement, and its integral over time where a spring holds
/// it.
struct Way {
    TrajectoryPoint end;
    double integral = 0.0;
};

Way way_of(const Trajectory& trajectory, double time)
{
    Way way{trajectory.after(time)};
    const Oscillator& oscillator = trajectory.propagator->oscillator;
    if (oscillator.stiffness > 0.0) { // from the equation of motion, integrated once
        const double forces = time * (trajectory.push + 0.5 * time * trajectory.ramp);
        way.integral = (forces - oscillator.damping * way.end.displacement -
                        (way.end.speed - trajectory.speed)) /
                       oscillator.stiffness;
    }
    return way;
}

/// The displacements of the axes, and their integrals over time.
struct AxisWays {
    PerAxis way{};
    PerAxis integral{};
};

AxisWays advance_coupled(BoxMotion& box, double time)
{
    AxisWays all;
    PerAxis velocity{};
    for (std::size_t j = 0; j < 3; ++j) {
        if (!box.room.coupled.modes[j].moves()) continue;
        const Way mode = way_of(box.room.coupled.modes[j], time);
        for (std::size_t i = 0; i < 3; ++i) {
            const double share = box.room.coupled.direction[j][i];
            velocity[i] += share * mode.end.speed;
            all.way[i] += share * mode.end.displacement;
            all.integral[i] += share * mode.integral;
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (!box.trajectories[i].moves()) continue;
        box.position[i] += all.way[i];
        box.velocity[i] = velocity[i];
    }
    return all;
}

inline AxisWays advance_axes(BoxMotion& box, double time)
{
    AxisWays all;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!box.trajectories[i].moves()) continue;
        const Way axis = way_of(box.trajectories[i], time);
        all.way[i] = axis.end.displacement;
        all.integral[i] = axis.integral;
        box.position[i] += axis.end.displacement;
        box.velocity[i] = axis.end.speed;
    }
    return all;
}

template <typename AnySpring>
void advance_spring(const BoxMotion& box, AnySpring& spring, double time, const AxisWays& ways)
{
    const double k = box.hands.stiffness_n_per_m;
    const double c = box.hands.damping_ns_per_m;
    const double closed = spring.closing * time + spring.along(ways.way);
    if (spring.phase == SpringPhase::pressing) {
        const double depths =
            time * (spring.depth + 0.5 * time * spring.closing) + spring.along(ways.integral);
        spring.impulse += k * depths + c * closed;
    } else if (spring.phase == SpringPhase::limited) {
        spring.impulse += box.hands.force_max_n * time;
    }
    spring.depth += closed;
}

void advance_grip(const BoxMotion& box, GripSpring& grip, double time, const AxisWays& ways)
{
    const double k = box.hands.stiffness_n_per_m;
    const double c = box.hands.damping_ns_per_m;
    for (std::size_t i = 0; i < 3; ++i) {
        const double stretched = time * grip.velocity[i] - ways.way[i];
        const double stretches =
            time * (grip.stretch[i] + 0.5 * time * grip.velocity[i]) - ways.integral[i];
        grip.impulse[i] += k * stretches + c * stretched;
        grip.stretch[i] += stretched;
    }
}

/// Advances the box and all springs, also the kinds that occur only in ticks without an exact
/// solution.
void advance_all(BoxMotion& box, double time)
{
    const AxisWays ways = box.is_coupled ? advance_coupled(box, time) : advance_axes(box, time);
    for (FaceSpring& spring : box.active_springs()) advance_spring(box, spring, time, ways);
    for (SlantedSpring& spring : box.active_slanted()) advance_spring(box, spring, time, ways);
    for (GripSpring& grip : box.active_grips()) advance_grip(box, grip, time, ways);
}

} // namespace

AxisOscillators::AxisOscillators(const HandDescription& hands, const BodyProperties& body,
                                 double tick)
    : inverse_mass_{1.0 / body.mass}
{
    constexpr double little = 1.0 / 16.0; // share of the velocity that changes in a tick
    soft_ = tick * (tick * hands.stiffness_n_per_m + hands.damping_ns_per_m) <= little * body.mass;
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
    BoxMotion other{hands, oscillators, obstacles, room};
    other.nearby = nearby;
    other.clearance = clearance;
    other.time_left = time_left;
    other.is_exact = is_exact;
    other.position = position;
    other.velocity = velocity;
    other.axes = axes;
    other.dry_friction = dry_friction;
    other.spring_count = spring_count;
    other.grip_count = grip_count;
    other.slanted_count = slanted_count;
    other.held_count = held_count;
    std::copy_n(springs.begin(), spring_count, other.springs.begin());
    std::copy_n(grips.begin(), grip_count, other.grips.begin());
    std::copy_n(slanted.begin(), slanted_count, other.slanted.begin());
    std::copy_n(held.begin(), held_count, other.held.begin());
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
    if (box.slanted_count == 0) {
        const auto push = [&](std::size_t i) { return box.trajectories[i].push; };
        is_on_plane = find_supports(box, push);
    } else {
        PerAxis damped{};
        box.is_coupled = add_slanted_springs(box, damped);
        box.spring_counts = springs;
        const auto push = [&](std::size_t i) { return box.trajectories[i].push + damped[i]; };
        is_on_plane = find_supports(box, push);
        for (std::size_t i = 0; i < 3; ++i) { // coupled, some axes move that would not move alone
            if (box.is_coupled && !box.axes[i].is_held())
                box.trajectories[i].propagator = &box.oscillators.of(springs[i], is_on_plane);
        }
    }
    box.is_on_plane = is_on_plane;
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
    if (box.is_exact) {
        const AxisWays ways = advance_axes(box, time);
        for (FaceSpring& spring : box.active_springs()) advance_spring(box, spring, time, ways);
    } else {
        advance_all(box, time);
    }
    box.time_left -= time;
}

} // namespace hapnet::scene
