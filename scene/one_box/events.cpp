// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/events.hpp"

namespace hapnet::scene {

namespace {

using Kind = SlideEvent::Kind;

/// `factor` times a spring's depth, plus `level`.
WatchedQuantity of_depth(const Spring& spring, double factor)
{
    const auto axis = spring.axis;
    WatchedQuantity watch{.level = factor * spring.depth, .slope = factor * spring.closing};
    watch.displacement_weight[axis] = factor * spring.sign;
    return watch;
}

/// `factor` times what a spring's force is without limits, plus `level`.
WatchedQuantity of_tension(const Slide& slide, const Spring& spring, double factor, double level)
{
    const double k = factor * slide.hands.stiffness_n_per_m;
    const double c = factor * slide.hands.damping_ns_per_m;
    const auto axis = spring.axis;
    WatchedQuantity watch{.level = level + k * spring.depth + c * spring.closing,
                          .slope = k * spring.closing};
    watch.displacement_weight[axis] = k * spring.sign;
    watch.speed_weight[axis] = c * spring.sign;
    return watch;
}

/// Most springs act for all the `time` that is looked at: whether this is one of them.
bool keeps_acting(const Slide& slide, const Spring& spring, double time)
{
    if (spring.phase != Phase::active) return false;
    const HandDescription& hands = slide.hands;
    const SlideAxis& axis = slide.axes[spring.axis];
    const double closing = spring.closing_at(slide.velocity[spring.axis]);
    const double k = hands.stiffness_n_per_m;
    const double c = hands.damping_ns_per_m;
    const double tension = k * spring.depth + c * closing;
    const double rate = std::abs(k * closing + c * spring.sign * axis.acceleration);
    const double bend = k * axis.most.acceleration + c * axis.most.jerk;
    const double change = time * (rate + 0.5 * time * bend);
    return tension >= change && hands.force_max_n - tension >= change;
}

struct SpringWatcher {
    const Slide& slide;
    std::uint32_t index;
    SlideEvent& first;

    void expect(const WatchedQuantity& watch, Phase next) const
    {
        const auto time = first_root(watch, slide.trajectories, 0.0, first.time);
        if (!time) return;
        first = {.time = *time, .kind = Kind::spring, .spring = index, .phase = next};
    }

    void look() const
    {
        const Spring& spring = slide.springs[index];
        const HandDescription& hands = slide.hands;
        const SlideAxis& axis = slide.axes[spring.axis];
        const double closing = spring.closing_at(slide.velocity[spring.axis]);
        const double k = hands.stiffness_n_per_m;
        const double c = hands.damping_ns_per_m;
        const double left = first.time;
        if (spring.phase == Phase::apart || spring.phase == Phase::slack) {
            const double away = spring.phase == Phase::apart ? -1.0 : 1.0;
            if (!stays_positive(away * spring.depth, away * closing, axis.most.acceleration,
                                left)) {
                expect(of_depth(spring, away),
                       spring.phase == Phase::apart ? Phase::active : Phase::apart);
            }
            if (spring.phase == Phase::apart) return;
        }
        const double tension = k * spring.depth + c * closing;
        const double rate = k * closing + c * spring.sign * axis.acceleration;
        const double bend = k * axis.most.acceleration + c * axis.most.jerk;
        if (spring.phase == Phase::slack) {
            if (!stays_positive(-tension, -rate, bend, left)) {
                expect(of_tension(slide, spring, -1.0, 0.0), Phase::active);
            }
            return;
        }
        const double room = hands.force_max_n - tension;
        if (spring.phase == Phase::limited) {
            if (!stays_positive(-room, rate, bend, left)) {
                expect(of_tension(slide, spring, 1.0, -hands.force_max_n), Phase::active);
            }
            return;
        }
        if (!stays_positive(tension, rate, bend, left)) {
            expect(of_tension(slide, spring, 1.0, 0.0), c > 0.0 ? Phase::slack : Phase::apart);
        }
        if (!stays_positive(room, -rate, bend, left)) {
            expect(of_tension(slide, spring, -1.0, hands.force_max_n), Phase::limited);
        }
    }
};

/// `side` times how far the centre is from a face.
WatchedQuantity of_gap(const Slide& slide, std::size_t axis, double side, double face)
{
    WatchedQuantity watch{.level = side * (slide.place[axis] - face)};
    watch.displacement_weight[axis] = side;
    return watch;
}

/// Whether the box cannot come to an obstacle in what is left of the tick: one axis keeps it away.
bool keeps_away(const Slide& slide, const Obstacle& obstacle, std::size_t i)
{
    const double gap = obstacle.gap(i, slide.place[i]);
    const double reach = slide.axes[i].reach;
    return gap > reach || (reach == 0.0 && gap >= 0.0);
}

bool is_out_of_reach(const Slide& slide, const Obstacle& obstacle)
{
    if (obstacle.is_plane) return keeps_away(slide, obstacle, obstacle.normal_axis);
    return keeps_away(slide, obstacle, 0) || keeps_away(slide, obstacle, 1) ||
           keeps_away(slide, obstacle, 2);
}

constexpr std::size_t nothing = 3;

/// The axis that keeps a box away from an obstacle at some moment: the one with the widest gap.
std::size_t keeping_away(const Slide& slide, const Obstacle& obstacle, double time, std::size_t but)
{
    std::size_t widest = nothing;
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (i == but) continue;
        const TrajectoryPoint motion = slide.trajectories[i].after(time);
        const double place = slide.place[i] + motion.displacement;
        const double gap = obstacle.gap(i, place);
        const double speed = slide.trajectories[i].moves() ? motion.speed : 0.0;
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
void look_for_impact(const Slide& slide, const Obstacle& obstacle, SlideEvent& first)
{
    constexpr int turns_max = 8; // an axis may open its gap again while another closes
    std::size_t axis = keeping_away(slide, obstacle, 0.0, nothing);
    double time = 0.0;
    for (int turn = 0; turn < turns_max && axis != nothing; ++turn) {
        const double place = slide.place[axis] + slide.trajectories[axis].after(time).displacement;
        const double side = obstacle.side(axis, place);
        const double face = obstacle.face(axis, side);
        const auto root =
            first_root(of_gap(slide, axis, side, face), slide.trajectories, time, first.time);
        if (!root) return;
        time = *root;
        const std::size_t other = keeping_away(slide, obstacle, time, axis);
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

/// What carries an axis may be lost: by the other forces, or behind its edge.
void look_at_carrier(const Slide& slide, std::size_t i, SlideEvent& first)
{
    const SlideAxis& axis = slide.axes[i];
    if (axis.load + axis.load_ramp * first.time < 0.0) {
        first = {.time = axis.load / -axis.load_ramp, .kind = Kind::unloading, .axis = i};
    }
    if (axis.carrier->is_plane) return;
    for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
        if (-axis.carrier->gap(j, slide.place[j]) > slide.axes[j].reach) continue;
        for (const double side : {1.0, -1.0}) {
            const double face = axis.carrier->face(j, side);
            const auto time =
                first_root(of_gap(slide, j, -side, face), slide.trajectories, 0.0, first.time);
            if (!time) continue;
            first = {.time = *time, .kind = Kind::edge, .axis = j};
            first.face = face;
        }
    }
}

/// Stops or turns back. A bounce that would be over before a tick has passed is none: otherwise a
/// box would come to rest by endlessly many.
void arrive(Slide& slide, const SlideEvent& event, double tick)
{
    const std::size_t i = event.axis;
    const Trajectory& trajectory = slide.trajectories[i];
    const double closing = -event.side * slide.velocity[i];
    const double acceleration = trajectory.acceleration(event.time, trajectory.after(event.time));
    const double back = slide.calm ? 0.0 : event.obstacle->restitution * closing;
    const double pressing = -event.side * acceleration;
    const bool is_over = 2.0 * back <= pressing * tick;
    slide.velocity[i] = is_over ? 0.0 : event.side * back;
    slide.axes[i].stopped = slide.calm;
}

} // namespace

bool is_uneventful(const Slide& slide)
{
    if (!slide.calm) {
        for (const Spring& spring : slide.active_springs()) {
            if (!keeps_acting(slide, spring, slide.left)) return false;
        }
        for (const SlideAxis& axis : slide.axes) {
            if (!axis.carrier) continue;
            if (!axis.carrier->is_plane) return false;
            if (axis.load + axis.load_ramp * slide.left < 0.0) return false;
        }
    }
    for (const std::uint32_t id : slide.near) {
        if (!is_out_of_reach(slide, slide.obstacles[id])) return false;
    }
    return true;
}

void look_for_event(const Slide& slide, SlideEvent& first)
{
    if (!slide.calm) {
        for (std::uint32_t i = 0; i < slide.spring_count; ++i) {
            if (keeps_acting(slide, slide.springs[i], first.time)) continue;
            SpringWatcher{slide, i, first}.look();
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (slide.axes[i].carrier) look_at_carrier(slide, i, first);
        }
    }
    for (const std::uint32_t id : slide.near) {
        const Obstacle& obstacle = slide.obstacles[id];
        if (!is_out_of_reach(slide, obstacle)) look_for_impact(slide, obstacle, first);
    }
}

void apply(Slide& slide, const SlideEvent& event, double tick)
{
    const HandDescription& hands = slide.hands;
    switch (event.kind) {
    case Kind::none: break;
    case Kind::spring: {
        Spring& spring = slide.springs[event.spring];
        const bool touches = spring.phase == Phase::apart;
        spring.phase = event.phase;
        const double speed = slide.velocity[spring.axis];
        if (touches && spring.tension(hands, speed) >= hands.force_max_n) {
            spring.phase = Phase::limited;
        }
        break;
    }
    case Kind::impact:
        slide.place[event.axis] = event.face;
        arrive(slide, event, tick);
        break;
    case Kind::unloading: slide.axes[event.axis].leaving = true; break;
    case Kind::edge: slide.place[event.axis] = event.face; break;
    case Kind::stop:
        for (std::size_t i = 0; i < 3; ++i) {
            if (slide.trajectories[i].moves()) slide.velocity[i] = 0.0;
        }
        break;
    case Kind::slip: slide.rubbing.slips = true; break;
    }
}

} // namespace hapnet::scene
