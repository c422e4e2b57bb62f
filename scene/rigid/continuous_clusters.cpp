// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// The part of continuous collision for bodies that stick together.
#include "scene/rigid/continuous.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hapnet::scene {

/// Calls visit(flyer) for a flyer that is stuck, and for all flyers that stick to it.
template <typename Visit>
void ContinuousCollision::for_stuck(FlyerIndex index, Visit visit)
{
    FlyerIndex i = index;
    do {
        visit(flyers_[i]);
        i = flyers_[i].next_stuck;
    } while (i != index);
}

/// Makes two bodies that touch stick together, or one body stick to a wall. When looks run short,
/// all movable bodies that are certain to meet stick together.
void ContinuousCollision::stick(const Surroundings& around, Meeting& meeting)
{
    const auto is_wall = [&](const Meeting& its) {
        return its.is_plane || !flyers_[its.a].is_movable || !flyers_[its.b].is_movable;
    };
    if (looks_run_short()) {
        for (Meeting& other : meetings_.all()) {
            if (other.is_over || !other.is_sure || is_wall(other)) continue;
            other.has_pushed = true;
            link(around, other.a, other.b);
        }
    }
    meeting.has_pushed = true;
    const FlyerIndex index = flyers_[meeting.a].is_movable ? meeting.a : meeting.b;
    link(around, index, is_wall(meeting) ? index : meeting.b);
    for (FlyerIndex i = 0; i < flyers_.size(); ++i)
        if (flyers_[i].is_newly_stuck) go_together(around, i, meeting.time);
    if (is_wall(meeting)) stick_to_wall(around, index, meeting);
}

/// Joins two bodies, and all that stick to either of them, into one cluster. If both are the same
/// body, it becomes a cluster of its own.
void ContinuousCollision::link(const Surroundings& around, FlyerIndex a, FlyerIndex b)
{
    for (const FlyerIndex index : {a, b}) {
        Flyer& flyer = flyers_[index];
        if (flyer.next_stuck != none) continue;
        flyer.next_stuck = index;
        flyer.is_newly_stuck = true;
    }
    bool are_linked = false;
    for_stuck(a, [&](const Flyer& flyer) { are_linked = are_linked || &flyer == &flyers_[b]; });
    if (are_linked) return;
    std::swap(flyers_[a].next_stuck, flyers_[b].next_stuck);
    flyers_[a].is_newly_stuck = true;
    ++around.state.interventions.clusters_stuck;
}

/// Gives linked bodies one motion from now on. They do not turn in the rest of the tick.
void ContinuousCollision::go_together(const Surroundings& around, FlyerIndex index, double time)
{
    Bodies& bodies = around.state.bodies;
    const auto still_to_gain = [&](Slot slot) {
        return (scales_.tick - time) * departures_[slot].acceleration;
    };
    const auto part_of = [&](const Flyer& flyer) {
        const Slot slot = bodies.slot_of[flyer.body];
        return ClusterPart{bodies.properties[slot], flyer.flight.at(time),
                           bodies.velocity.at(slot) - still_to_gain(slot),
                           bodies.angular_momentum.at(slot)};
    };
    const auto own = static_cast<ClusterIndex>(clusters_.size());
    Cluster& cluster = clusters_.add();
    cluster = {};
    for_stuck(index, [&](const Flyer& flyer) { cluster.count(part_of(flyer)); });
    for_stuck(index, [&](const Flyer& flyer) { cluster.join(part_of(flyer)); });
    cluster.stick();
    const bool is_alone = flyers_[index].next_stuck == index;
    for_stuck(index, [&](Flyer& flyer) {
        const ClusterPart part = part_of(flyer);
        const Slot slot = bodies.slot_of[flyer.body];
        if (!is_alone) {
            bodies.velocity.put(slot, cluster.motion_of(part).velocity + still_to_gain(slot));
            bodies.angular_momentum.put(slot, cluster.angular_momentum_of(part));
            note_push(bodies, flyer.body);
        }
        const glm::dquat orientation = flyer.flight.orientation_at(time);
        flyer.flight.velocity = cluster.velocity();
        flyer.flight.spin = glm::dvec3{0.0};
        flyer.roll.stop(time);
        flyer.flight.put(part.box.centre, orientation, time);
        flyer.cluster = own;
        flyer.is_newly_stuck = false;
        flyer.is_released = flyer.has_changed = true;
        flyer.has_stopped = false;
    });
}

/// Removes the speed against a wall from bodies that stick together, see Cluster::stick_to_wall().
void ContinuousCollision::stick_to_wall(const Surroundings& around, FlyerIndex index,
                                        const Meeting& meeting)
{
    Bodies& bodies = around.state.bodies;
    const double time = meeting.time;
    glm::dvec3 normal = gap_of(around, meeting, time).normal; // from the first to the second
    glm::dvec3 ground{0.0};
    bool is_driven = false;
    if (!meeting.is_plane) {
        if (meeting.a == index) normal = -normal;
        const Flyer& wall = flyers_[meeting.a == index ? meeting.b : meeting.a];
        ground = wall.flight.velocity;
        is_driven = wall.is_kinematic;
    }
    const glm::dvec3 change = clusters_[flyers_[index].cluster].stick_to_wall(normal, ground);
    for_stuck(index, [&](Flyer& flyer) {
        const Slot slot = bodies.slot_of[flyer.body];
        const glm::dvec3 before = bodies.velocity.at(slot);
        bodies.velocity.put(slot, before + change);
        if (is_driven) {
            const glm::dvec3 mean =
                before + 0.5 * change - (scales_.tick - time) * departures_[slot].acceleration;
            const glm::dvec3 push = bodies.properties[slot].mass * change;
            departures_[slot].beginning.driven.add(
                {driven_energy(glm::dot(push, ground), glm::dot(push, mean)), length(ground)});
        }
        note_push(bodies, flyer.body);
        flyer.flight.centre -= time * change;
        flyer.flight.velocity += change;
    });
    ++around.state.interventions.clusters_stuck;
}

} // namespace hapnet::scene
