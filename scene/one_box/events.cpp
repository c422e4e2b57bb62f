// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/events.hpp"

#include "scene/one_box/coupled.hpp"

#include <type_traits>

namespace hapnet::scene {

namespace {

using Kind = Event::Kind;

/// Returns `factor` times a spring's depth, as a quantity to watch.
template <typename AnySpring>
WatchedQuantity watch_depth(const AnySpring& spring, double factor)
{
    WatchedQuantity watch{.level = factor * spring.depth, .slope = factor * spring.closing};
    spring.add_along(watch.displacement_weight, factor);
    return watch;
}

/// Returns `factor` times a spring's force without limits, plus `level`, as a quantity to watch.
template <typename AnySpring>
WatchedQuantity watch_tension(const BoxMotion& box, const AnySpring& spring, double factor,
                              double level)
{
    const double k = factor * box.hands.stiffness_n_per_m;
    const double c = factor * box.hands.damping_ns_per_m;
    WatchedQuantity watch{.level = level + k * spring.depth + c * spring.closing,
                          .slope = k * spring.closing};
    spring.add_along(watch.displacement_weight, k);
    spring.add_along(watch.speed_weight, c);
    return watch;
}

/// A spring's force without limits, its rate, and the bound of that rate's change.
struct Tension {
    double force, rate, bend;
    double closing;      // m/s
    double acceleration; // m/s^2: bound of the acceleration of the depth

    template <typename AnySpring>
    Tension(const BoxMotion& box, const AnySpring& spring)
    {
        const double k = box.hands.stiffness_n_per_m;
        const double c = box.hands.damping_ns_per_m;
        const auto& axes = box.axes;
        closing = spring.closing + spring.along(box.velocity);
        acceleration =
            spring.most_along([&](std::size_t i) { return axes[i].bounds.acceleration; });
        force = k * spring.depth + c * closing;
        rate = k * closing +
               c * spring.along_each([&](std::size_t i) { return axes[i].acceleration; });
        bend = k * acceleration +
               c * spring.most_along([&](std::size_t i) { return axes[i].bounds.jerk; });
    }
};

/// True if a spring presses for the whole `time`, as most do.
template <typename AnySpring>
bool keeps_acting(const BoxMotion& box, const AnySpring& spring, double time)
{
    if (spring.phase != SpringPhase::pressing) return false;
    const Tension tension{box, spring};
    const double change = time * (std::abs(tension.rate) + 0.5 * time * tension.bend);
    return tension.force >= change && box.hands.force_max_n - tension.force >= change;
}

/// Finds the events of springs. `kind` is the kind of the springs.
template <typename AnySpring>
struct SpringEventFinder {
    const BoxMotion& box;
    const AnySpring& spring;
    Event what; // the event without its next phase
    Event& first;

    void expect_phase(const WatchedQuantity& watch, SpringPhase next) const
    {
        Event event = what;
        event.phase = next;
        expect(box, watch, 0.0, first, event);
    }

    void find() const
    {
        const HandDescription& hands = box.hands;
        const double left = first.time;
        const Tension tension{box, spring};
        if (spring.phase == SpringPhase::apart || spring.phase == SpringPhase::slack) {
            const double away = spring.phase == SpringPhase::apart ? -1.0 : 1.0;
            if (!stays_positive(away * spring.depth, away * tension.closing, tension.acceleration,
                                left)) {
                expect_phase(watch_depth(spring, away), spring.phase == SpringPhase::apart
                                                            ? SpringPhase::pressing
                                                            : SpringPhase::apart);
            }
            if (spring.phase == SpringPhase::apart) return;
        }
        if (spring.phase == SpringPhase::slack) {
            if (!stays_positive(-tension.force, -tension.rate, tension.bend, left)) {
                expect_phase(watch_tension(box, spring, -1.0, 0.0), SpringPhase::pressing);
            }
            return;
        }
        const double room = hands.force_max_n - tension.force;
        if (spring.phase == SpringPhase::limited) {
            if (!stays_positive(-room, tension.rate, tension.bend, left)) {
                expect_phase(watch_tension(box, spring, 1.0, -hands.force_max_n),
                             SpringPhase::pressing);
            }
            return;
        }
        if (!stays_positive(tension.force, tension.rate, tension.bend, left)) {
            expect_phase(watch_tension(box, spring, 1.0, 0.0),
                         hands.damping_ns_per_m > 0.0 ? SpringPhase::slack : SpringPhase::apart);
        }
        if (!stays_positive(room, -tension.rate, tension.bend, left)) {
            expect_phase(watch_tension(box, spring, -1.0, hands.force_max_n), SpringPhase::limited);
        }
    }
};

template <typename Springs>
void find_spring_events(const BoxMotion& box, const Springs& springs, Kind kind, Event& first)
{
    std::uint32_t index = 0;
    for (const auto& spring : springs) {
        const Event what{.kind = kind, .spring = index++};
        if (keeps_acting(box, spring, first.time)) continue;
        using AnySpring = std::remove_cvref_t<decltype(spring)>;
        SpringEventFinder<AnySpring>{box, spring, what, first}.find();
    }
}

/// Returns the distance of the box's centre from a face, times `side`, as a quantity to watch.
WatchedQuantity watch_gap(const BoxMotion& box, std::size_t axis, double side, double face)
{
    WatchedQuantity watch{.level = side * (box.position[axis] - face)};
    watch.displacement_weight[axis] = side;
    return watch;
}

/// True if the axis `i` keeps the box away from an obstacle for the rest of the tick.
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

/// Returns the axis that keeps a box away from an obstacle at some moment: the one with the widest
/// gap.
std::size_t separating_axis(const BoxMotion& box, const Obstacle& obstacle, double time,
                            std::size_t but)
{
    std::size_t widest = nothing;
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (i == but) continue;
        const TrajectoryPoint motion = motion_after(box, i, time);
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

/// Finds the impact of the box on an obstacle, at which the last of the three axes has closed its
/// gap.
void find_impact(const BoxMotion& box, const Obstacle& obstacle, Event& first)
{
    constexpr int rounds_max = 8; // an axis may open its gap again while another closes
    std::size_t axis = separating_axis(box, obstacle, 0.0, nothing);
    double time = 0.0;
    for (int turn = 0; turn < rounds_max && axis != nothing; ++turn) {
        const double place = box.position[axis] + motion_after(box, axis, time).displacement;
        const double side = obstacle.side(axis, place);
        const double face = obstacle.face(axis, side);
        Event reached = first; // the moment at which this axis reaches the face
        if (!expect(box, watch_gap(box, axis, side, face), time, reached, {})) {
            if (reached.kind == Kind::unknown) first = reached;
            return;
        }
        time = reached.time;
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
    if (axis != nothing) first = {.time = time, .kind = Kind::unknown};
}

/// Finds the moment at which an axis loses its support: when other forces lift it off, or behind
/// the support's edge.
void find_loss_of_support(const BoxMotion& box, std::size_t i, Event& first)
{
    const AxisMotion& axis = box.axes[i];
    if (box.is_coupled) {
        const Event unloaded{.kind = Kind::unloading, .axis = i};
        expect(box, watch_load(box, i), 0.0, first, unloaded);
    } else if (axis.load + axis.load_ramp * first.time < 0.0) {
        first = {.time = axis.load / -axis.load_ramp, .kind = Kind::unloading, .axis = i};
    }
    if (axis.support->is_plane) return;
    for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
        if (-axis.support->gap(j, box.position[j]) > box.axes[j].reach) continue;
        for (const double side : {1.0, -1.0}) {
            const double face = axis.support->face(j, side);
            Event event{.kind = Kind::edge, .axis = j};
            event.face = face;
            expect(box, watch_gap(box, j, -side, face), 0.0, first, event);
        }
    }
}

/// Stops the box or reverses its velocity. A bounce that would be over within a tick is left out.
/// Otherwise a box would come to rest by endlessly many bounces.
void handle_impact(BoxMotion& box, const Event& event, double tick)
{
    const std::size_t i = event.axis;
    const double closing = -event.side * box.velocity[i];
    const double back = event.obstacle->material.restitution * closing;
    const double pressing = -event.side * acceleration_after(box, i, event.time);
    const bool is_over = 2.0 * back <= pressing * tick;
    box.velocity[i] = is_over ? 0.0 : event.side * back;
}

/// Updates the springs' phases after a jump of the velocity, at which the dampers' forces jump,
/// too.
void update_phases(BoxMotion& box)
{
    if (box.hands.damping_ns_per_m == 0.0) return;
    for (FaceSpring& spring : box.active_springs())
        spring.update_phase(box.hands, spring.along(box.velocity));
    for (SlantedSpring& spring : box.active_slanted())
        spring.update_phase(box.hands, spring.along(box.velocity));
}

template <typename AnySpring>
void enter_phase(const BoxMotion& box, AnySpring& spring, SpringPhase phase)
{
    const HandDescription& hands = box.hands;
    const bool touches = spring.phase == SpringPhase::apart;
    spring.phase = phase;
    if (touches && spring.tension(hands, spring.along(box.velocity)) >= hands.force_max_n)
        spring.phase = SpringPhase::limited;
}

} // namespace

bool expect(const BoxMotion& box, const WatchedQuantity& watch, double from, Event& first,
            const Event& what)
{
    const RootSearch search = search_root(box, watch, from, first.time);
    if (search.end == RootSearch::End::none) return false;
    const bool is_found = search.end == RootSearch::End::found;
    first = is_found ? what : Event{.kind = Kind::unknown};
    first.time = search.time;
    return is_found;
}

WatchedQuantity watch_load(const BoxMotion& box, std::size_t i)
{
    const double away = box.axes[i].support == box.axes[i].below ? 1.0 : -1.0;
    const auto [damping, stiffness] = box.oscillators.spring();
    WatchedQuantity watch{.level = -away * box.trajectories[i].push,
                          .slope = -away * box.trajectories[i].ramp};
    for (const SlantedSpring& spring : box.active_slanted()) {
        if (spring.phase != SpringPhase::pressing) continue;
        spring.add_along(watch.displacement_weight, away * spring.normal[i] * stiffness);
        spring.add_along(watch.speed_weight, away * spring.normal[i] * damping);
    }
    return watch;
}

bool is_uneventful(const BoxMotion& box)
{
    if (box.slanted_count > 0) return false;
    for (const FaceSpring& spring : box.active_springs()) {
        if (!keeps_acting(box, spring, box.time_left)) return false;
    }
    for (const AxisMotion& axis : box.axes) {
        if (!axis.support) continue;
        if (!axis.support->is_plane) return false;
        if (axis.load + axis.load_ramp * box.time_left < 0.0) return false;
    }
    for (const std::uint32_t id : box.nearby) {
        if (!is_out_of_reach(box, box.obstacles[id])) return false;
    }
    return true;
}

void find_event(const BoxMotion& box, Event& first)
{
    find_spring_events(box, box.active_springs(), Kind::spring, first);
    find_spring_events(box, box.active_slanted(), Kind::slanted_spring, first);
    for (std::size_t i = 0; i < 3; ++i) {
        if (box.axes[i].support) find_loss_of_support(box, i, first);
    }
    for (const std::uint32_t id : box.nearby) {
        const Obstacle& obstacle = box.obstacles[id];
        if (!is_out_of_reach(box, obstacle)) find_impact(box, obstacle, first);
    }
}

void handle_event(BoxMotion& box, const Event& event, double tick)
{
    switch (event.kind) {
    case Kind::none:
    case Kind::unknown: break;
    case Kind::spring: enter_phase(box, box.springs[event.spring], event.phase); break;
    case Kind::slanted_spring: enter_phase(box, box.slanted[event.spring], event.phase); break;
    case Kind::impact:
        box.position[event.axis] = event.face;
        handle_impact(box, event, tick);
        update_phases(box);
        break;
    case Kind::unloading: box.axes[event.axis].is_losing_support = true; break;
    case Kind::edge: box.position[event.axis] = event.face; break;
    case Kind::stop:
        for (std::size_t i = 0; i < 3; ++i) {
            if (box.trajectories[i].moves()) box.velocity[i] = 0.0;
        }
        update_phases(box);
        break;
    case Kind::slip: box.dry_friction.starts_slipping = true; break;
    }
}

} // namespace hapnet::scene
