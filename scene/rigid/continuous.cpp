// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/continuous.hpp"

#include "scene/collide/box_box.hpp"
#include "scene/collide/box_plane.hpp"
#include "scene/collide/sweep.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"
#include "scene/rigid/allowed_overlap.hpp"
#include "scene/rigid/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// The limits of the touches of one body in a tick. After `touches_many` the body no longer bounces,
// and overlaps by more with each touch: where many bodies are wedged into each other, touches would
// have no end. After `touches_max` it sticks.
constexpr std::uint32_t touches_max = 24, touches_many = 12;
constexpr double many_times = 4.0;
// The number of looks at two bodies in a tick: a base, and a number for each movable body, which
// grows with the number of bodies, as each body then has more neighbours. When half of the looks
// are used up, all touching bodies stick.
constexpr std::uint32_t steps_base = 192, steps_per_body = 16, steps_per_pair = 2,
                        steps_per_body_max = 96;
// The cost of a touch, in looks.
constexpr std::uint32_t steps_per_touch = 8;
// The average number of meetings for each movable body.
constexpr std::size_t meetings_per_body_max = 64;
constexpr std::size_t meetings_max = 65'536;
// The number of meetings whose search costs about one look.
constexpr std::size_t meetings_per_step = 256;

// A body that is farther than this behind the face that it touched has passed through it, in
// smallest half edges of the two.
constexpr double behind_max = 0.1;
// The least speed of a bounce, in units of the speed that gravity adds in a tick, as for bounces
// within a tick. A slower body does not bounce.
constexpr double least_bounce = 2.0;

std::uint32_t steps_for(const Bodies& bodies)
{
    const PartId movable = bodies.movable_parts();
    return steps_base +
           movable * std::min(steps_per_body + steps_per_pair * movable, steps_per_body_max);
}

std::size_t room_for_meetings(const WorldConfig& config, const Bodies& bodies)
{
    const std::size_t each =
        std::min(bodies.parts_count() + config.planes.size(), meetings_per_body_max);
    return std::min(bodies.movable_parts() * each, meetings_max);
}

/// Returns the part of gravity and pushes that contacts do not bear: the change of velocity in the
/// tick, where that is less. At an impact the change is greater, and happens at one moment.
glm::dvec3 borne(const glm::dvec3& steady, const glm::dvec3& change)
{
    constexpr double rounding = 1e-9;
    const bool is_borne = glm::dot(change, change) < (1.0 - rounding) * glm::dot(steady, steady);
    return is_borne ? change : steady;
}

} // namespace

ContinuousCollision::ContinuousCollision(const WorldConfig& config, const Bodies& bodies,
                                         const Scales& scales)
    : scales_{scales},
      departures_{bodies.movable},
      flyers_{bodies.size()},
      meetings_{room_for_meetings(config, bodies)},
      clusters_{2 * std::size_t{bodies.movable}},
      flyer_of_(bodies.size(), none),
      woken_{bodies.movable},
      steps_max_{steps_for(bodies)},
      steps_kept_{steps_max_ / 2}
{}

void ContinuousCollision::begin(const WorldConfig& config, const WorldState& state,
                                std::span<const Slot> active,
                                std::span<const BodyIntegration> integrations,
                                ContactSolver& solver)
{
    const Bodies& bodies = state.bodies;
    departures_.resize(bodies.movable);
    for (Slot slot = bodies.awake; slot < bodies.movable; ++slot)
        departures_[slot].acceleration = glm::dvec3{0.0};
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        const BodyProperties& properties = bodies.properties[slot];
        Departure& departure = departures_[slot];
        departure.acceleration = gravity_on(properties, config.gravity) +
                                 properties.inverse_mass * state.pushes[properties.id];
        departure.beginning = {bodies.position.at(slot), bodies.orientation.at(slot),
                               bodies.velocity.at(slot), bodies.angular_momentum.at(slot)};
        departure.turn = Departure::Turn::free;
        departure.first_touch.time = scales_.tick;
        departure.least_near = properties.least_half;
    }
    for (const Slot slot : active) {
        const BodyIntegration& integration = integrations[slot + 1];
        const BodyMotion& mean = solver.mean_motion(slot + 1);
        Departure& departure = departures_[slot];
        departure.acceleration =
            borne(departure.acceleration, scales_.rate * (solver.end_motion(slot + 1).velocity -
                                                          integration.start.velocity));
        departure.start = integration.start;
        departure.first_touch = integration.first_touch;
        departure.least_near = integration.least_near;
        departure.turn =
            integration.has_hands ? Departure::Turn::by_hands : Departure::Turn::steady;
        departure.spin = spin_through_tick(integration, bodies, slot, mean, scales_.tick);
    }
}

template <BroadPhase search>
void ContinuousCollision::solve(const Surroundings& around, std::span<const Slot> active,
                                const PairFinder<search>& pairs)
{
    Bodies& bodies = around.state.bodies;
    flyers_.clear();
    meetings_.clear();
    clusters_.clear();
    woken_.clear();
    steps_left_ = steps_max_;
    const auto add_fast = [&](Slot slot) {
        if (goes_far(chord(bodies, slot), 0.0, least_near(bodies, slot)))
            flyers_[add_flyer(around, bodies.properties[slot].id)].is_fast = true;
    };
    for (const Slot slot : active) add_fast(slot);
    const auto fast = static_cast<FlyerIndex>(flyers_.size());
    for (Slot slot = bodies.movable; slot < bodies.moving; ++slot) add_fast(slot);
    const auto all = static_cast<FlyerIndex>(flyers_.size());
    for (FlyerIndex i = 0; i < all; ++i) find_others(around, pairs, i, 0.0);
    for (FlyerIndex i = 0; i < fast; ++i) {
        if (!has_to_bend(around, i)) continue;
        bend(around, i);
        find_others(around, pairs, i, 0.0);
        advance_all(around, i, 0.0, none);
    }
    while (go_to_next_touch(around, pairs)) {}
    for (const Flyer& flyer : flyers_.all()) {
        flyer_of_[flyer.body] = none;
        if (!flyer.has_changed) continue;
        const Slot slot = bodies.slot_of[flyer.body];
        bodies.position.put(slot, flyer.flight.centre + scales_.tick * flyer.flight.velocity);
        bodies.orientation.put(slot, flyer.roll.turned(flyer.flight.orientation_at(scales_.tick),
                                                       bodies.properties[slot], scales_.tick));
    }
}

/// Searches again for the others in the path of a flyer whose motion changes at a moment, and for
/// the times of their touches. It omits one other, which is `done`.
template <BroadPhase search>
void ContinuousCollision::go_on(const Surroundings& around, const PairFinder<search>& pairs,
                                FlyerIndex index, double time, FlyerIndex done)
{
    Flyer& flyer = flyers_[index];
    if (flyer.is_movable && !flyer.has_stopped && !flyer.is_fast)
        flyer.is_fast =
            goes_far(flyer.flight, time,
                     least_near(around.state.bodies, around.state.bodies.slot_of[flyer.body]));
    if (flyer.is_fast && !flyer.has_stopped) find_others(around, pairs, index, time);
    advance_all(around, index, time, done);
}

/// Handles the next touch or change of a body's motion. Returns false when there is none.
template <BroadPhase search>
bool ContinuousCollision::go_to_next_touch(const Surroundings& around,
                                           const PairFinder<search>& pairs)
{
    const MeetingIndex next = earliest();
    const double time = next == none ? scales_.tick : meetings_[next].time;
    const FlyerIndex bent = next_bend(time);
    if (bent != none) {
        const double then = flyers_[bent].bend;
        release(around, flyers_[bent], then);
        go_on(around, pairs, bent, then, none);
        return true;
    }
    if (next == none) return false;
    const auto spend = [&](std::size_t cost) {
        steps_left_ -= std::min(steps_left_, static_cast<std::uint32_t>(cost));
    };
    spend(meetings_.size() / meetings_per_step);
    if (steps_left_ == 0) {
        stop_all(around, time);
        return false;
    }
    if (!meetings_[next].is_sure) {
        const bool is_last = looks_run_short();
        advance(around, meetings_[next], time, is_last ? steps_many : steps_at_once);
        if (!is_last || meetings_[next].is_sure || meetings_[next].is_over) return true;
    }
    if (is_too_much(meetings_[next])) {
        const auto before = static_cast<ClusterIndex>(clusters_.size());
        Meeting& met = meetings_[next];
        met.gap = std::min(met.gap, gap_of(around, met, time).distance);
        met.gap -= next_overlap(met.gap, met.smallest);
        stick(around, met);
        const FlyerIndex at_wall = flyers_[met.a].is_movable ? met.a : met.b;
        const auto now = static_cast<FlyerIndex>(flyers_.size());
        for (FlyerIndex i = 0; i < now; ++i) {
            const ClusterIndex its = flyers_[i].cluster;
            if (its == none || (its < before && its != flyers_[at_wall].cluster)) continue;
            go_on(around, pairs, i, time, none);
        }
        return true;
    }
    spend(steps_per_touch);
    touch(around, meetings_[next]);
    const Meeting met = meetings_[next];
    go_on(around, pairs, met.a, time, none);
    if (!met.is_plane) go_on(around, pairs, met.b, time, met.a);
    return true;
}

/// Returns the straight motion from the body's former to its present place.
SteadyBox ContinuousCollision::chord(const Bodies& bodies, Slot slot) const
{
    const BodyProperties& properties = bodies.properties[slot];
    SteadyBox flight{.centre = bodies.position.at(slot),
                     .orientation = bodies.orientation.at(slot),
                     .half = properties.half,
                     .radius = outer_radius(properties.half, properties.rounding),
                     .rounding = properties.rounding};
    if (properties.is_kinematic) { // it has not moved yet
        flight.velocity = bodies.velocity.at(slot);
        flight.spin = bodies.angular_momentum.at(slot);
    }
    if (slot >= bodies.awake) return flight; // asleep or not movable: it has not moved yet
    const Departure& departure = departures_[slot];
    flight.velocity = scales_.rate * (flight.centre - departure.beginning.position);
    if (properties.turning != Turning::locked) {
        switch (departure.turn) {
        case Departure::Turn::steady:
            flight.spin = steady_spin(departure.beginning.orientation, flight.orientation,
                                      departure.spin, scales_.tick);
            break;
        case Departure::Turn::by_hands:
            flight.spin =
                scales_.rate * turn_between(departure.beginning.orientation, flight.orientation);
            break;
        case Departure::Turn::free:
            flight.spin = rotates_uniformly(properties)
                              ? bodies.angular_velocity(slot)
                              : steady_spin(departure.beginning.orientation, flight.orientation,
                                            mean_spin(departure.beginning.orientation,
                                                      {bodies.angular_momentum.at(slot),
                                                       properties.inverse_inertia},
                                                      scales_.tick),
                                            scales_.tick);
            break;
        }
    }
    flight.centre = departure.beginning.position;
    flight.orientation = departure.beginning.orientation;
    return flight;
}

/// Returns the smallest half edge of a body and of the bodies that it may meet. For a body that is
/// not movable it is that of all movable bodies.
double ContinuousCollision::least_near(const Bodies& bodies, Slot slot) const
{
    if (slot >= bodies.movable) return scales_.size;
    return slot < bodies.awake ? departures_[slot].least_near : bodies.properties[slot].least_half;
}

/// True if the path in the rest of the tick is so long that the body could pass something.
bool ContinuousCollision::goes_far(const SteadyBox& flight, double time, double least_near) const
{
    const double turning = flight.core_radius() * length(flight.spin);
    return (scales_.tick - time) * (length(flight.velocity) + turning) > far_way * least_near;
}

ContinuousCollision::FlyerIndex ContinuousCollision::add_flyer(const Surroundings& around,
                                                               BodyId body)
{
    if (flyer_of_[body] != none) return flyer_of_[body];
    const auto index = static_cast<FlyerIndex>(flyers_.size());
    flyer_of_[body] = index;
    const Bodies& bodies = around.state.bodies;
    const Slot slot = bodies.slot_of[body];
    Flyer& flyer = flyers_.add();
    flyer = {};
    flyer.body = body;
    flyer.is_movable = slot < bodies.movable;
    flyer.is_kinematic = bodies.properties[slot].is_kinematic;
    flyer.has_parts = bodies.properties[slot].has_parts();
    flyer.flight = chord(bodies, slot);
    if (flyer.is_movable && slot >= bodies.awake)
        departures_[slot].beginning = {flyer.flight.centre, flyer.flight.orientation};
    return index;
}

/// True if a body cannot have taken the straight path to the place where it was put.
bool ContinuousCollision::has_to_bend(const Surroundings& around, FlyerIndex index)
{
    const Bodies& bodies = around.state.bodies;
    const Slot slot = bodies.slot_of[flyers_[index].body];
    const Departure& departure = departures_[slot];
    if (departure.first_touch.time >= scales_.tick) return false;
    bool meets = got_past(bodies, departure);
    for_meetings_of(index, [&](Meeting& meeting) {
        if (!meeting.is_over && !meeting.is_sure)
            advance(around, meeting, meeting.time, steps_many);
        meets = meets || !meeting.is_over;
    });
    return meets;
}

/// Returns the first body whose bend comes before a moment.
ContinuousCollision::FlyerIndex ContinuousCollision::next_bend(double time) const
{
    FlyerIndex found = none;
    for (FlyerIndex i = 0; i < flyers_.size(); ++i) {
        const Flyer& flyer = flyers_[i];
        if (flyer.is_released || flyer.has_stopped || flyer.bend > time) continue;
        if (found == none || flyer.bend < flyers_[found].bend) found = i;
    }
    return found;
}

/// True if a body is behind the face of the other body that it should have touched first.
bool ContinuousCollision::got_past(const Bodies& bodies, const Departure& departure) const
{
    const FirstTouch& first = departure.first_touch;
    const OrientedBox own = shape_of(bodies, first.own);
    const Slot of_other = bodies.slot_of[first.other];
    OrientedBox other = shape_of(bodies, first.other);
    if (bodies.properties[of_other].is_kinematic) {
        SteadyBox flight = chord(bodies, of_other);
        if (bodies.properties[of_other].has_parts()) set_part(flight, bodies.parts[first.other]);
        other = flight.at(scales_.tick);
    }
    const double gap = glm::dot(first.normal, other.centre - own.centre) -
                       half_extent(own, first.normal) - half_extent(other, first.normal);
    return gap < -behind_max * smallest_half(own, other);
}

/// Bends a body's path. The body moves as it began until its first touch, and then with its
/// velocity at the end. For a body that hits something with a corner, that is more accurate than
/// the straight path to its place at the end.
void ContinuousCollision::bend(const Surroundings& around, FlyerIndex index)
{
    Flyer& flyer = flyers_[index];
    const Departure& departure = departures_[around.state.bodies.slot_of[flyer.body]];
    flyer.flight.velocity = departure.start.velocity;
    flyer.flight.spin = departure.start.spin;
    flyer.bend = departure.first_touch.time;
    flyer.has_changed = true;
}

/// Lets a body move from now on with its velocity at the end of the tick, less the part that
/// constant forces will have added until then.
void ContinuousCollision::release(const Surroundings& around, Flyer& flyer, double time)
{
    const Bodies& bodies = around.state.bodies;
    const Slot slot = bodies.slot_of[flyer.body];
    const glm::dvec3 centre = flyer.flight.centre + time * flyer.flight.velocity;
    const glm::dquat orientation = flyer.flight.orientation_at(time);
    const double left = scales_.tick - time;
    flyer.flight.velocity =
        bodies.velocity.at(slot) - (0.5 * left) * departures_[slot].acceleration;
    // A touch uses the spin at this moment, which may not stay: see touch().
    flyer.roll.advance(time);
    flyer.flight.spin = spin_of(bodies, slot, orientation, flyer.roll);
    flyer.flight.put(centre, orientation, time);
    flyer.is_released = true;
    flyer.has_changed = true;
}

/// Stops a body for the rest of the tick. Its velocity is kept, and it moves on in the next tick.
void ContinuousCollision::stop(Flyer& flyer, double time)
{
    flyer.flight.centre += time * flyer.flight.velocity;
    flyer.flight.orientation = flyer.flight.orientation_at(time);
    flyer.flight.velocity = flyer.flight.spin = glm::dvec3{0.0};
    flyer.roll.stop(time);
    flyer.has_stopped = flyer.has_changed = true;
}

/// Stops all bodies that go far and may meet something at their present places.
void ContinuousCollision::stop_all(const Surroundings& around, double time)
{
    ++around.state.interventions.budgets_spent;
    for (Flyer& flyer : flyers_.all())
        if (flyer.is_movable && flyer.is_fast && !flyer.has_stopped && flyer.first != none)
            stop(flyer, time);
}

/// Lists the others in the path of a flyer from a moment on.
template <BroadPhase search>
void ContinuousCollision::find_others(const Surroundings& around, const PairFinder<search>& pairs,
                                      FlyerIndex index, double time)
{
    const SteadyBox flight = flyers_[index].flight;
    const double until = std::min(scales_.tick, flyers_[index].bend);
    const double end = flyers_[index].is_released ? scales_.tick : until;
    // This margin also covers the paths of others that move without being fast.
    const Bodies& all = around.state.bodies;
    const double margin =
        flight.radius + far_way * least_near(all, all.slot_of[flyers_[index].body]);
    const Aabb way =
        grown(hull(flight.centre + time * flight.velocity, flight.centre + end * flight.velocity),
              glm::dvec3{margin});
    if (contains(flyers_[index].searched, way)) return;
    const bool is_first = flyers_[index].first == none;
    const bool has_parts = !around.state.bodies.parts.empty();
    flyers_[index].searched = way;
    const auto meet = [&](std::uint32_t other, bool is_plane) {
        if (!flyers_[index].is_movable && (is_plane || !flyers_[other].is_movable)) return;
        if ((!is_first || has_parts) && are_to_meet(index, other, is_plane)) return;
        Meeting meeting{.a = index, .b = other, .is_plane = is_plane, .time = time};
        if (!has_parts) return add_meeting(around, meeting);
        const Bodies& bodies = around.state.bodies;
        bodies.for_parts(flyers_[index].body, [&](PartId part) {
            meeting.part_a = part;
            if (is_plane) return add_meeting(around, meeting);
            bodies.for_parts(flyers_[other].body, [&](PartId its) {
                meeting.part_b = its;
                add_meeting(around, meeting);
            });
        });
    };
    const BodyId own = flyers_[index].body;
    pairs.for_overlapping(way, [&](PartId part) {
        const BodyId id = has_parts ? around.state.bodies.body_of(part) : part;
        if (id == own) return;
        const FlyerIndex other = add_flyer(around, id);
        if (are_to_meet(other, index, false)) return;
        meet(other, false);
    });
    for (FlyerIndex other = 0; other < flyers_.size(); ++other) {
        // Such bodies may have been thrown out of the fat boxes in which the search finds them.
        if (other == index || !flyers_[other].is_fast) continue;
        if (!overlap(way, flyers_[other].searched)) continue;
        if (are_to_meet(index, other, false) || are_to_meet(other, index, false)) continue;
        meet(other, false);
    }
    if (is_first) {
        for (std::uint32_t plane = 0; plane < around.config.planes.size(); ++plane)
            meet(plane, true);
    }
}

/// True if two bodies that touch have touched so often that they stick.
bool ContinuousCollision::is_too_much(const Meeting& meeting) const
{
    if (looks_run_short()) return true;
    const auto is_done = [&](const Flyer& flyer) {
        return flyer.cluster != none || flyer.touches >= touches_max;
    };
    return is_done(flyers_[meeting.a]) || (!meeting.is_plane && is_done(flyers_[meeting.b]));
}

/// Handles a touch of two bodies. If they approach each other, they push each other. After a number
/// of touches they stay.
void ContinuousCollision::touch(const Surroundings& around, Meeting& meeting)
{
    const double time = meeting.time;
    const std::array<FlyerIndex, 2> both{meeting.a, meeting.is_plane ? meeting.a : meeting.b};
    const std::size_t count = meeting.is_plane ? 1 : 2;
    bool any_released = false;
    for (std::size_t i = 0; i < count; ++i) {
        Flyer& flyer = flyers_[both[i]];
        if (!flyer.is_movable || flyer.has_stopped || flyer.is_released) continue;
        release(around, flyer, time);
        any_released = true;
    }
    const bool pushed = exchange_impulse(around, meeting);
    if (pushed) ++around.state.interventions.sweeps_continued;
    const bool many = std::max(flyers_[both[0]].touches, flyers_[both[1]].touches) >= touches_many;
    meeting.gap -= (many ? many_times : 1.0) * next_overlap(meeting.gap, meeting.smallest);
    const bool one_has_stopped =
        count == 2 && (flyers_[both[0]].has_stopped || flyers_[both[1]].has_stopped);
    for (std::size_t i = 0; i < count; ++i) {
        Flyer& flyer = flyers_[both[i]];
        if (!flyer.is_movable || flyer.has_stopped) continue;
        // Without a push, only an outdated spin made them seem to approach each other.
        if (pushed || !any_released) {
            release(around, flyer, time);
            ++flyer.touches;
        }
        const bool is_in_its_way = !pushed && !any_released && one_has_stopped;
        if (flyer.touches <= touches_max && !is_in_its_way) continue;
        ++around.state.interventions.paths_cut;
        stop(flyer, time);
    }
}

/// Returns the state of a flyer at a moment.
Toucher ContinuousCollision::toucher(const Surroundings& around, const Flyer& flyer,
                                     double time) const
{
    const Bodies& bodies = around.state.bodies;
    const Slot slot = bodies.slot_of[flyer.body];
    const OrientedBox box = flyer.flight.at(time);
    const bool moves = flyer.is_movable || flyer.is_kinematic;
    Toucher its{.moves = moves, .centre = box.centre, .response = {}, .motion = {}};
    if (flyer.is_kinematic)
        its.motion = around.kinematics.of(bodies, slot).motion_at(time, scales_.tick);
    if (!flyer.is_movable) return its;
    its.response = response_of(bodies.properties[slot], box.axes);
    its.motion.velocity =
        bodies.velocity.at(slot) - (scales_.tick - time) * departures_[slot].acceleration;
    its.motion.spin = its.response.inverse_inertia * bodies.angular_momentum.at(slot);
    return its;
}

/// Returns where two bodies touch, and the rounding of both there.
ContinuousCollision::TouchPoints ContinuousCollision::touch_points(const Surroundings& around,
                                                                   const Meeting& meeting) const
{
    const Bodies& bodies = around.state.bodies;
    const double margin = near_share * overlap_step * meeting.smallest;
    SteadyBox room_a, room_b;
    const SteadyBox& a = flight_of(bodies, meeting.a, meeting.part_a, room_a);
    if (meeting.is_plane) {
        const PlaneDescription& plane = around.config.planes[meeting.b];
        const PlaneSurface surface{plane.normal, plane.offset_m};
        return {collide(surface, a.at(meeting.time), margin), 0.0, a.rounding};
    }
    const SteadyBox& b = flight_of(bodies, meeting.b, meeting.part_b, room_b);
    BoxBoxMemory memory;
    const OrientedBox here_a = a.at(meeting.time), here_b = b.at(meeting.time);
    TouchPoints points{collide(here_a, here_b, margin, memory), a.rounding, b.rounding};
    const auto part_of = [&](FlyerIndex index, PartId part) {
        return flyers_[index].has_parts ? part : PartId{flyers_[index].body};
    };
    around.config.internal_faces.leave_outer({part_of(meeting.a, meeting.part_a), here_a},
                                             {part_of(meeting.b, meeting.part_b), here_b},
                                             points.manifold);
    return points;
}

/// Applies the impulse of a touch. Returns true if there was one.
bool ContinuousCollision::exchange_impulse(const Surroundings& around, Meeting& meeting)
{
    Bodies& bodies = around.state.bodies;
    const double time = meeting.time;
    const Flyer& first = flyers_[meeting.a];
    const Flyer& second = flyers_[meeting.is_plane ? meeting.a : meeting.b];
    Toucher a;
    const Toucher b = toucher(around, second, time);
    Material material = bodies.properties[bodies.slot_of[second.body]].material;
    if (meeting.is_plane) {
        a.centre = b.centre;
        material = combined(material, around.config.planes[meeting.b].material);
    } else {
        a = toucher(around, first, time);
        material = combined(material, bodies.properties[bodies.slot_of[first.body]].material);
    }
    const TouchPoints points = touch_points(around, meeting);
    if (points.manifold.count == 0) return false;
    ContactBlock block;
    block.a = a.moves ? 1 : 0;
    block.b = b.moves ? 2 : 0;
    prepare(block, points.manifold, {a.centre, b.centre}, {});
    block.set_roundings(points.rounding_a, points.rounding_b);
    block.friction = material.friction;
    const bool many = first.touches >= touches_many || second.touches >= touches_many;
    block.restitution = many ? 0.0 : material.restitution;
    const ContactVector impulse = touch_impulse(block, a, b, least_bounce * scales_.fall);
    if (std::all_of(impulse.begin(), impulse.end(), [](double part) { return part == 0.0; }))
        return false;
    const auto push = [&](BodyId body, const Wrench& by, const glm::dvec3& arm) {
        apply_impulse(bodies, bodies.slot_of[body], by, arm);
        note_push(bodies, body);
    };
    meeting.has_pushed = true;
    const Wrench on_b = wrench(block, impulse);
    const Wrench on_a{-on_b.impulse, -on_b.angular};
    if (second.is_movable) push(second.body, on_b, block.arm_b);
    if (!meeting.is_plane && first.is_movable) push(first.body, on_a, block.arm_a);
    if (!first.is_kinematic && !second.is_kinematic) return true;
    const bool is_b = first.is_kinematic;
    const Flyer& driven = is_b ? second : first;
    const Wrench& by = is_b ? on_b : on_a;
    const glm::dvec3& arm = is_b ? block.arm_b : block.arm_a;
    const glm::dvec3& surface_arm = is_b ? block.arm_a : block.arm_b;
    const BodyMotion& surface = (is_b ? a : b).motion;
    const BodyMotion now = toucher(around, driven, time).motion;
    const double taken = 0.5 * (work_of(by, arm, (is_b ? b : a).motion) + work_of(by, arm, now));
    departures_[bodies.slot_of[driven.body]].beginning.driven.add(
        {driven_energy(work_of(by, surface_arm, surface), taken),
         length(velocity_at(surface, surface_arm))});
    return true;
}

template void ContinuousCollision::solve(const Surroundings& around, std::span<const Slot> active,
                                         const PairFinder<BroadPhase::all_pairs>& pairs);
template void ContinuousCollision::solve(const Surroundings& around, std::span<const Slot> active,
                                         const PairFinder<BroadPhase::grid>& pairs);

} // namespace hapnet::scene
