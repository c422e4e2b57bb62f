// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/pose_correction.hpp"

#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hapnet::peer {

namespace {

/// Returns the step of a tick toward zero error, at a rate, and limited to the speed `most`.
glm::dvec3 step_for(const glm::dvec3& error, double rate_hz, double most, double tick_s)
{
    return tick_s * base::limited(base::Velocity{rate_hz * error}, most).value;
}

glm::dvec3 weight_of(const scene::World& world, scene::BodyId id)
{
    const scene::Bodies& bodies = world.state().bodies;
    return bodies.properties[bodies.slot_of[id]].mass * world.frozen().gravity;
}

const wire::BodyState* body_of(const Remote& other, scene::BodyId id)
{
    return other.body(static_cast<std::uint16_t>(id));
}

} // namespace

PoseCorrection::PoseCorrection(std::size_t bodies, const Rates& rates)
    : rates_{rates}, bodies_(bodies)
{
    for (Body& body : bodies_) body.past.resize(past_max);
}

void PoseCorrection::begin_pushes()
{
    for (Body& body : bodies_) body.force = body.torque = glm::dvec3{0.0};
}

void PoseCorrection::add_push(std::size_t body, base::Force force, base::Displacement lever)
{
    bodies_[body].force += force.value;
    bodies_[body].torque += glm::cross(lever.value, force.value);
}

double PoseCorrection::keep_together(const Copy& copy)
{
    const Situation& situation = copy.situation;
    SharedPoses& poses = *situation.poses;
    const SharedPoses::Touchers touchers = poses.touchers(situation);
    poses.find_movers(copy.world, situation, touchers);
    double given_j = 0.0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        switch (poses.mover(i)) {
        case SharedPoses::Mover::own: bodies_[i].touched = situation.now; break;
        case SharedPoses::Mover::none: given_j += settle(copy, i); break;
        case SharedPoses::Mover::others:
            given_j += follow(copy, i, poses.mover_among(touchers, i)->index);
            break;
        }
    }
    remember(copy);
    return given_j;
}

/// Follows the leader's pose, but only after the leader has reported a touch that is later than
/// this hand's last one. Until then this copy is more up to date.
double PoseCorrection::follow(const Copy& copy, std::size_t body, std::size_t leader)
{
    const SharedPoses& poses = *copy.situation.poses;
    const ProxyHand& proxy = copy.proxies[leader];
    const scene::BodyId id = poses.bodies()[body].id;
    const wire::BodyState* const there = body_of(copy.situation.others[leader], id);
    const auto& own_touch = bodies_[body].touched;
    if (there == nullptr || (own_touch && proxy.touched_at() <= own_touch)) return 0.0;
    const double ahead_s = proxy.eta() * base::to_seconds(proxy.age(copy.situation.now));
    const scene::BodyState own = copy.world.body(id);
    const scene::BodyState target = poses.target_of(copy.world, body, *there);
    const glm::dvec3 place = target.position.value + ahead_s * target.velocity.value;
    const glm::dquat orientation =
        scene::rotated(target.orientation, ahead_s * target.angular_velocity);
    return correct(copy, body,
                   {.way = place - own.position.value,
                    .turn = scene::turn_between(own.orientation, orientation)});
}

double PoseCorrection::settle(const Copy& copy, std::size_t body)
{
    SharedPoses& poses = *copy.situation.poses;
    const scene::BodyId id = poses.bodies()[body].id;
    const scene::BodyState before = copy.world.body(id);
    poses.settle(copy.world, copy.situation, body);
    if (poses.is_settling(body)) {
        const scene::BodyState after = copy.world.body(id);
        Motion& corrected = bodies_[body].corrected;
        corrected.way += (after.position - before.position).value;
        corrected.turn += scene::turn_between(before.orientation, after.orientation);
        return 0.0; // no energy is given: no hand is on the body
    }
    const auto error = error_in_past(copy, body);
    return error ? correct(copy, body, *error) : 0.0;
}

/// Returns the difference of this copy's body from the owner's at the time of the owner's last
/// received state, minus the corrections since then. nullopt: this copy is the owner's, or nothing
/// is known.
std::optional<PoseCorrection::Motion> PoseCorrection::error_in_past(const Copy& copy,
                                                                    std::size_t body) const
{
    const Situation& situation = copy.situation;
    const SharedPoses& poses = *situation.poses;
    const auto owner = std::ranges::find(situation.others, poses.owner(body), &Remote::id);
    if (owner == situation.others.end() || !(owner->freshness() > 0.0)) return std::nullopt;
    const wire::BodyState* const there = body_of(*owner, poses.bodies()[body].id);
    const auto index = static_cast<std::size_t>(owner - situation.others.begin());
    const auto ago =
        static_cast<std::uint64_t>(copy.proxies[index].age(situation.now) / situation.tick);
    if (there == nullptr || ago == 0 || ago > ticks_ || ago >= past_max) return std::nullopt;
    const Body& own = bodies_[body];
    const Past& then = own.past[(ticks_ - ago) % past_max];
    const scene::BodyState target = poses.target_of(copy.world, body, *there);
    const Motion since{.way = own.corrected.way - then.corrected.way,
                       .turn = own.corrected.turn - then.corrected.turn};
    return Motion{.way = target.position.value - then.place - since.way,
                  .turn = scene::turn_between(then.orientation, target.orientation) - since.turn};
}

double PoseCorrection::correct(const Copy& copy, std::size_t body, const Motion& error)
{
    if (base::norm(base::Displacement{error.way}) <= SharedPoses::same_place_m &&
        base::norm(base::Displacement{error.turn}) <= SharedPoses::same_angle_rad)
        return 0.0; // so that the body may sleep
    const SharedBody& shared = copy.situation.poses->bodies()[body];
    const double tick_s = base::to_seconds(copy.situation.tick);
    const double most = rates_.speed_m_per_s;
    const Motion step{.way = step_for(error.way, rates_.rate_hz, most, tick_s),
                      .turn = step_for(error.turn, rates_.rate_hz, most / shared.reach_m, tick_s)};
    const base::Position before = copy.world.position(shared.id);
    copy.world.shift(shared.id, {step.way}, step.turn);
    const glm::dvec3 moved = (copy.world.position(shared.id) - before).value;
    Body& own = bodies_[body];
    own.corrected.way += moved;
    own.corrected.turn += step.turn;
    const glm::dvec3 force = own.force + weight_of(copy.world, shared.id);
    return std::max(0.0, -glm::dot(force, moved) - glm::dot(own.torque, step.turn));
}

void PoseCorrection::remember(const Copy& copy)
{
    ++ticks_;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const scene::BodyState body = copy.world.body(copy.situation.poses->bodies()[i].id);
        bodies_[i].past[ticks_ % past_max] = {body.position.value, body.orientation,
                                              bodies_[i].corrected};
    }
}

} // namespace hapnet::peer
