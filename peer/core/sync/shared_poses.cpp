// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/shared_poses.hpp"

#include "proto/base/ensure.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/query.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace hapnet::peer {

namespace {

constexpr double at_rest_m_per_s = 1e-3;

double length_of(const glm::dvec3& v) { return base::norm(base::Displacement{v}); }

BodySet bit_of_body(std::size_t body) { return static_cast<BodySet>(1U << body); }

bool has_body(BodySet set, std::size_t body) { return (set >> body & 1U) != 0; }

/// Returns the only axis of the world about which a body may turn; zero if it may turn about any
/// axis.
glm::dvec3 only_axis_of(scene::Turning turning)
{
    switch (turning) {
    case scene::Turning::about_x: return {1.0, 0.0, 0.0};
    case scene::Turning::about_y: return {0.0, 1.0, 0.0};
    case scene::Turning::about_z: return {0.0, 0.0, 1.0};
    case scene::Turning::free:
    case scene::Turning::locked: break;
    }
    return glm::dvec3{0.0};
}

/// Returns a state between two states, with the velocity of the second.
scene::BodyState between(const scene::BodyState& from, const scene::BodyState& to, double share)
{
    scene::BodyState state = to;
    state.position = from.position + share * (to.position - from.position);
    state.orientation = scene::rotated(
        from.orientation, share * scene::turn_between(from.orientation, to.orientation));
    return state;
}

/// True if both this copy and its owner's are at rest at the same place.
bool agree(const scene::BodyState& own, const scene::BodyState& there)
{
    const double alike =
        own.orientation.w * there.orientation.w + own.orientation.x * there.orientation.x +
        own.orientation.y * there.orientation.y + own.orientation.z * there.orientation.z;
    constexpr double half_angle = 0.5 * SharedPoses::same_angle_rad;
    return base::norm(own.position - there.position) <= SharedPoses::same_place_m &&
           1.0 - alike * alike <= half_angle * half_angle &&
           base::norm(own.velocity) <= at_rest_m_per_s &&
           base::norm(there.velocity) <= at_rest_m_per_s;
}

} // namespace

SharedPoses::SharedPoses(std::vector<SharedBody> bodies, std::uint16_t own_id,
                         const AtRest::Times& times)
    : bodies_{std::move(bodies)}, own_id_{own_id}, times_{times}
{
    base::ensure(!bodies_.empty() && bodies_.size() <= wire::bodies_max);
}

std::optional<std::size_t> SharedPoses::index_of(scene::BodyId id) const
{
    const auto found =
        std::ranges::find_if(bodies_, [id](const SharedBody& body) { return body.id == id; });
    if (found == bodies_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - bodies_.begin());
}

SharedPoses::Touchers SharedPoses::touchers(const Situation& situation) const
{
    Touchers touchers;
    for (std::size_t i = 0; i < situation.others.size(); ++i) {
        const Remote& other = situation.others[i];
        const wire::BodyState* const body = other.touched();
        if (!(other.freshness() > 0.0) || body == nullptr) continue;
        const auto index = index_of(body->body);
        if (!index || touchers.count == touchers.all.size()) continue;
        touchers.all[touchers.count++] = {&other, i, *index};
    }
    return touchers;
}

void SharedPoses::find_movers(const scene::World& world, const Situation& situation,
                              const Touchers& touchers)
{
    note_contacts(world, situation.now);
    find_groups(situation.now);
    movers_.fill(Mover::none);
    const auto mark = [&](std::size_t touched, Mover mover, std::uint16_t id) {
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (has_body(groups_[touched], i) && movers_[i] != Mover::own) movers_[i] = mover;
        ownership_.touch(groups_[touched], id, situation.now);
    };
    const scene::HandTouch& own = world.touch(own_hand);
    const auto pushed = own.touching ? index_of(own.body) : std::nullopt;
    if (pushed) mark(*pushed, Mover::own, own_id_);
    for (const Toucher& toucher : touchers.list())
        mark(toucher.body, Mover::others, toucher.other->id());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (movers_[i] == Mover::none) continue;
        untouched_since_[i].reset();
        blends_[i].reset();
        owners_[i] = movers_[i] == Mover::own ? own_id_ : mover_among(touchers, i)->other->id();
    }
}

const SharedPoses::Toucher* SharedPoses::mover_among(const Touchers& touchers,
                                                     std::size_t body) const
{
    for (const Toucher& toucher : touchers.list())
        if (has_body(groups_[toucher.body], body)) return &toucher;
    return nullptr;
}

void SharedPoses::note_contacts(const scene::World& world, base::TimePoint now)
{
    if (bodies_.size() == 1) return;
    std::array<scene::Contact, 32> room{};
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const std::size_t found = scene::contacts_of(world, bodies_[i].id, room);
        for (std::size_t k = 0; k < std::min(found, room.size()); ++k) {
            const scene::Contact& contact = room[k];
            if (contact.other.kind != scene::Thing::Kind::body) continue;
            const bool is_first = contact.body == bodies_[i].id;
            const auto other = index_of(is_first ? contact.other.index : contact.body);
            if (!other) continue; // a fixed body connects nothing
            touching_[i][*other] = now;
            touching_[*other][i] = now;
        }
    }
}

void SharedPoses::find_groups(base::TimePoint now)
{
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        groups_[i] = bit_of_body(i);
        for (std::size_t k = 0; k < bodies_.size(); ++k)
            if (touching_[i][k] && now - *touching_[i][k] < contact_lasts)
                groups_[i] = static_cast<BodySet>(groups_[i] | bit_of_body(k));
    }
    // Bodies that touch only through others also belong to one group (Warshall 1962).
    for (std::size_t through = 0; through < bodies_.size(); ++through) {
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (has_body(groups_[i], through))
                groups_[i] = static_cast<BodySet>(groups_[i] | groups_[through]);
    }
}

void SharedPoses::take_over(scene::World& world, const Remote& other) const
{
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const auto* const there = other.body(static_cast<std::uint16_t>(bodies_[i].id));
        if (there != nullptr) place(world, i, target_of(world, i, *there));
    }
}

void SharedPoses::follow(scene::World& world, const Situation& situation, std::size_t body,
                         const Remote& other) const
{
    const auto* const there = other.body(static_cast<std::uint16_t>(bodies_[body].id));
    if (there != nullptr) put(world, situation, body, target_of(world, body, *there));
}

/// Returns the peers that may own a body: this peer and those that are heard.
SharedPoses::Present SharedPoses::present_in(const Situation& situation) const
{
    Present present;
    present.ids[present.count++] = own_id_;
    for (const Remote& other : situation.others) {
        if (other.freshness() > 0.0 && present.count < present.ids.size())
            present.ids[present.count++] = other.id();
    }
    std::sort(present.ids.begin(), present.ids.begin() + present.count);
    return present;
}

void SharedPoses::settle(scene::World& world, const Situation& situation, std::size_t body)
{
    auto& since = untouched_since_[body];
    auto& blend = blends_[body];
    if (!since) since = situation.now;
    const Present present = present_in(situation);
    const std::uint16_t owner = ownership_.owner(groups_[body], present.list(), situation.now);
    owners_[body] = owner;
    const bool waited = times_.after && situation.now - *since >= *times_.after;
    const auto found = std::ranges::find_if(
        situation.others, [owner](const Remote& each) { return each.id() == owner; });
    const wire::BodyState* const there =
        owner == own_id_ || found == situation.others.end()
            ? nullptr
            : found->body(static_cast<std::uint16_t>(bodies_[body].id));
    if (!waited || there == nullptr) {
        blend.reset();
        return;
    }
    const scene::BodyState own = world.body(bodies_[body].id);
    if (!blend || blend->owner != owner) blend = Blend{owner, situation.now, own};
    const scene::BodyState target = target_of(world, body, *there);
    if (agree(own, target)) return;
    const base::Duration passed = situation.now - blend->start;
    if (passed >= times_.within) return put(world, situation, body, target);
    const double share = base::to_seconds(passed) / base::to_seconds(times_.within);
    put(world, situation, body, between(blend->from, target, share));
}

scene::BodyState SharedPoses::target_of(const scene::World& world, std::size_t body,
                                        const wire::BodyState& there) const
{
    const SharedBody& shared = bodies_[body];
    scene::BodyState target = world.body(shared.id);
    target.position = there.position;
    target.velocity = there.velocity;
    if (!shared.turns() || !there.turning) return target;
    const glm::dquat orientation = there.turning->orientation.quaternion();
    target.angular_velocity = there.turning->angular_velocity;
    if (shared.turning == scene::Turning::free) {
        target.orientation = orientation;
        return target;
    }
    const glm::dvec3 axis = only_axis_of(shared.turning);
    const glm::dquat by = orientation * glm::conjugate(target.orientation);
    const glm::dvec3 along = glm::dot(glm::dvec3{by.x, by.y, by.z}, axis) * axis;
    const glm::dquat turn{by.w, along.x, along.y, along.z};
    if (!(glm::dot(turn, turn) > 0.0)) return target;
    target.orientation = base::normalized(base::normalized(turn) * target.orientation);
    target.angular_velocity = glm::dot(target.angular_velocity, axis) * axis;
    return target;
}

void SharedPoses::put(scene::World& world, const Situation& situation, std::size_t body,
                      const scene::BodyState& target) const
{
    const SharedBody& shared = bodies_[body];
    const scene::BodyState own = world.body(shared.id);
    const double turn =
        shared.turns() ? length_of(scene::turn_between(own.orientation, target.orientation)) : 0.0;
    const double way_m = base::norm(target.position - own.position) + shared.reach_m * turn;
    const double way_max_m = approach_m_per_s * base::to_seconds(situation.tick);
    scene::BodyState there = target;
    if (way_m > way_max_m && is_near_hand(world, body, way_m)) {
        there = between(own, target, way_max_m / way_m);
        there.velocity = base::limited(target.velocity, approach_m_per_s);
        there.angular_velocity = base::limited(base::Velocity{target.angular_velocity},
                                               approach_m_per_s / shared.reach_m)
                                     .value;
    }
    place(world, body, there);
}

void SharedPoses::place(scene::World& world, std::size_t body, const scene::BodyState& there) const
{
    const SharedBody& shared = bodies_[body];
    if (shared.turns()) {
        world.place(shared.id, there);
    } else {
        world.place(shared.id, there.position, there.velocity);
    }
}

/// True if a body, or its path, may touch this hand or a body that this hand moves.
bool SharedPoses::is_near_hand(const scene::World& world, std::size_t body, double within_m) const
{
    const glm::dvec3 place = world.position(bodies_[body].id).value;
    const double reach_m = bodies_[body].reach_m + within_m;
    const scene::HandInput& hand = world.state().hands[own_hand];
    const double hand_reach_m = reach_m + world.frozen().hands.radius_m;
    if (hand.present && length_of(hand.position.value - place) <= hand_reach_m) return true;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (movers_[i] != Mover::own || i == body) continue;
        const glm::dvec3 apart = world.position(bodies_[i].id).value - place;
        if (length_of(apart) <= reach_m + bodies_[i].reach_m) return true;
    }
    return false;
}

} // namespace hapnet::peer
