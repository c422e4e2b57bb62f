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

void touch_face(Slide& slide, const Obstacle& obstacle, std::size_t i)
{
    if (slide.place[i] == obstacle.high[i]) slide.axes[i].below = &obstacle;
    if (slide.place[i] == obstacle.low[i]) slide.axes[i].above = &obstacle;
}

void touch(Slide& slide, const Obstacle& obstacle)
{
    if (obstacle.is_plane) {
        touch_face(slide, obstacle, obstacle.normal_axis);
        return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (obstacle.gap(i, slide.place[i]) != 0.0) continue;
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        if (is_between(obstacle, j, slide.place[j], slide.velocity[j]) &&
            is_between(obstacle, k, slide.place[k], slide.velocity[k])) {
            touch_face(slide, obstacle, i);
        }
    }
}

/// Whether the axis rests on what it touches, pressed on it by its accelerations.
void press(SlideAxis& axis, double speed, const Trajectory& trajectory)
{
    if (speed != 0.0 || axis.leaving) return;
    const bool is_idle = trajectory.push == 0.0;
    if (axis.below && (trajectory.push < 0.0 || (is_idle && trajectory.ramp <= 0.0))) {
        axis.carrier = axis.below;
        axis.load = -trajectory.push;
        axis.load_ramp = -trajectory.ramp;
    } else if (axis.above && (trajectory.push > 0.0 || (is_idle && trajectory.ramp >= 0.0))) {
        axis.carrier = axis.above;
        axis.load = trajectory.push;
        axis.load_ramp = trajectory.ramp;
    }
}

/// Adds the hands' springs; how many there are on each axis.
std::array<std::size_t, 3> add_springs(Slide& slide)
{
    const auto [damping, stiffness] = slide.laws.spring();
    std::array<std::size_t, 3> count{};
    for (const Spring& spring : slide.active_springs()) {
        Trajectory& trajectory = slide.trajectories[spring.axis];
        if (spring.phase == Phase::active) {
            trajectory.push -= spring.sign * (stiffness * spring.depth + damping * spring.closing);
            trajectory.ramp -= spring.sign * (stiffness * spring.closing);
            ++count[spring.axis];
        } else if (spring.phase == Phase::limited) {
            trajectory.push -= spring.sign * (slide.hands.force_max_n * slide.laws.inverse_mass());
        }
    }
    for (const Grip& grip : slide.active_grips()) {
        for (std::size_t i = 0; i < 3; ++i) {
            slide.trajectories[i].push += stiffness * grip.stretch[i] + damping * grip.velocity[i];
            slide.trajectories[i].ramp += stiffness * grip.velocity[i];
            ++count[i];
        }
    }
    return count;
}

} // namespace

SlideLaws::SlideLaws(const HandDescription& hands, const BodyProperties& body, double tick)
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

Slide Slide::copy() const
{
    Slide other{hands, laws, obstacles};
    other.near = near;
    other.room = room;
    other.left = left;
    other.calm = calm;
    other.place = place;
    other.velocity = velocity;
    other.axes = axes;
    other.trajectories = trajectories;
    other.rubbing = rubbing;
    other.spring_count = spring_count;
    other.grip_count = grip_count;
    other.slanted_count = slanted_count;
    std::copy_n(springs.begin(), spring_count, other.springs.begin());
    std::copy_n(grips.begin(), grip_count, other.grips.begin());
    std::copy_n(slanted.begin(), slanted_count, other.slanted.begin());
    return other;
}

void set_courses(Slide& slide)
{
    for (std::size_t i = 0; i < 3; ++i) {
        SlideAxis& axis = slide.axes[i];
        axis.below = axis.above = axis.carrier = nullptr;
        slide.trajectories[i] = {nullptr, slide.velocity[i], axis.steady, 0.0};
    }
    for (const std::uint32_t id : slide.near) touch(slide, slide.obstacles[id]);
    const auto springs = add_springs(slide);

    bool is_on_plane = false;
    for (std::size_t i = 0; i < 3; ++i) {
        SlideAxis& axis = slide.axes[i];
        if (axis.below || axis.above)
            press(axis, slide.trajectories[i].speed, slide.trajectories[i]);
        axis.leaving = false;
        if (axis.carrier && axis.carrier->is_plane) is_on_plane = true;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const SlideAxis& axis = slide.axes[i];
        if (axis.is_held() || slide.trajectories[i].is_idle()) continue;
        slide.trajectories[i].propagator = &slide.laws.of(springs[i], is_on_plane);
    }
}

void with_bounds(Slide& slide)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const Trajectory& trajectory = slide.trajectories[i];
        SlideAxis& axis = slide.axes[i];
        if (!trajectory.moves()) {
            axis.acceleration = axis.reach = 0.0;
            axis.most = {};
            continue;
        }
        axis.acceleration =
            trajectory.push - trajectory.propagator->oscillator.damping * trajectory.speed;
        const double jerk = trajectory.jerk(axis.acceleration, trajectory.speed);
        axis.most = bounds(*trajectory.propagator, axis.acceleration, jerk, slide.left);
        axis.reach =
            slide.left * (std::abs(trajectory.speed) + 0.5 * slide.left * axis.most.acceleration);
    }
}

void advance(Slide& slide, double time)
{
    PerAxis way{};
    PerAxis way_integral{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Trajectory& trajectory = slide.trajectories[i];
        if (!trajectory.moves()) continue;
        const TrajectoryPoint motion = trajectory.after(time);
        const Oscillator& oscillator = trajectory.propagator->oscillator;
        if (oscillator.stiffness > 0.0) { // from the law itself, integrated once
            const double forces = time * (trajectory.push + 0.5 * time * trajectory.ramp);
            way_integral[i] = (forces - oscillator.damping * motion.displacement -
                               (motion.speed - trajectory.speed)) /
                              oscillator.stiffness;
        }
        way[i] = motion.displacement;
        slide.place[i] += motion.displacement;
        slide.velocity[i] = motion.speed;
    }
    const double k = slide.hands.stiffness_n_per_m;
    const double c = slide.hands.damping_ns_per_m;
    for (Spring& spring : slide.active_springs()) {
        const double closed = spring.closing * time + spring.sign * way[spring.axis];
        if (spring.phase == Phase::active) {
            const double depths = time * (spring.depth + 0.5 * time * spring.closing) +
                                  spring.sign * way_integral[spring.axis];
            spring.impulse += k * depths + c * closed;
        } else if (spring.phase == Phase::limited) {
            spring.impulse += slide.hands.force_max_n * time;
        }
        spring.depth += closed;
    }
    for (Grip& grip : slide.active_grips()) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double stretched = time * grip.velocity[i] - way[i];
            const double stretches =
                time * (grip.stretch[i] + 0.5 * time * grip.velocity[i]) - way_integral[i];
            grip.impulse[i] += k * stretches + c * stretched;
            grip.stretch[i] += stretched;
        }
    }
    slide.left -= time;
}

} // namespace hapnet::scene
