// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/base_algorithm.hpp"

#include "peer/core/sync/base_bodies.hpp"

#include <algorithm>

namespace hapnet::peer {

void BaseAlgorithm::hear(const ReceivedState& received)
{
    if (options_.follow != Follow::relative) return;
    if (options_.displacement_from != DisplacementFrom::increments) return;
    const wire::BodyState* const body = received.state.bodies.first();
    const bool counts = received.state.touching || options_.follow_while == FollowWhile::always;
    // The body's displacement in the sender's tick. Messages do not contain it, but it follows from
    // the velocity.
    if (received.taken && body && counts) increments_ += body->velocity * received.span;
}

void BaseAlgorithm::forget()
{
    lead_.reset();
    remote_before_.reset();
    increments_ = {};
}

Outcome BaseAlgorithm::tick(scene::World& world, const Situation& situation)
{
    if (situation.poses != nullptr) return tick_bodies(world, situation, options_);
    return tick(world, situation, combined_remote(situation, options_));
}

Outcome BaseAlgorithm::tick(scene::World& world, const Situation& situation,
                            const CombinedRemote& remote)
{
    Outcome outcome;
    outcome.remote_touching = remote.touching;
    const bool alone = options_.both_push == BothPush::stronger;
    const bool leads = alone && remote_leads(situation, remote);
    if (remote.touching && !alone) {
        world.push(situation.body, remote.force);
        outcome.remote_force = remote.force;
    }
    if (options_.follow == Follow::relative) {
        place_before_ = world.body(situation.body).position;
        remote_moved_ = remote_displacement(remote);
    }
    world.tick();
    const scene::HandTouch& own = world.touch(own_hand);
    outcome.touched = own;
    outcome.on_hand = own.on_hand;
    own_force_n_ = base::norm(own.on_body);
    if (own.touching && options_.remote_force_on == RemoteForceOn::body_and_hand) {
        outcome.on_hand += remote.force;
    }
    if (const auto& state = situation.remote.state()) outcome.remote_hip = state->hip;

    if (own.touching || remote.touching) {
        at_rest_.interrupt();
    }
    const bool always = options_.follow_while == FollowWhile::always && remote.heard;
    const bool follows = own.touching ? leads : remote.touching || always;
    if (follows && remote.pose) {
        follow(world, situation, remote);
    } else if (!own.touching) {
        settle(world, situation, remote);
    }
    return outcome;
}

bool BaseAlgorithm::remote_leads(const Situation& situation, const CombinedRemote& remote)
{
    if (!remote.touching) {
        lead_.reset();
        return false;
    }
    const double remote_n = base::norm(remote.force);
    const bool is_stronger =
        remote_n > own_force_n_ || (remote_n == own_force_n_ && situation.yields);
    const auto clock = situation.clock.estimate();
    // The uncertainty is half the round trip, unless the clocks are one.
    const base::Duration round_trip =
        clock ? std::max(2 * clock->uncertainty, clock->round_trip) : base::Duration{0};
    const base::Duration kept = std::max(options_.hysteresis, round_trip);
    if (!lead_ || (lead_->is_remote != is_stronger && situation.now - lead_->since >= kept)) {
        lead_ = Lead{is_stronger, situation.now};
    }
    return lead_->is_remote;
}

base::Displacement BaseAlgorithm::remote_displacement(const CombinedRemote& remote)
{
    const base::Displacement increments = increments_;
    increments_ = {};
    base::Displacement between;
    if (remote.pose) {
        if (remote_before_) between = remote.pose->position - *remote_before_;
        remote_before_ = remote.pose->position;
    }
    return options_.displacement_from == DisplacementFrom::increments ? increments : between;
}

void BaseAlgorithm::follow(scene::World& world, const Situation& situation,
                           const CombinedRemote& remote)
{
    if (options_.follow == Follow::absolute) {
        return put_there(world, situation.body, *remote.pose);
    }
    const bool onward = options_.displacement == DisplacementSign::current_minus_previous;
    const double sign = onward ? 1.0 : -1.0;
    // This replaces the result of this copy's own dynamics.
    base::Position position = place_before_ + sign * remote_moved_;
    if (options_.bleed) {
        const double constant_s = base::to_seconds(*options_.bleed);
        const double tick_s = base::to_seconds(situation.tick);
        const double share = tick_s < constant_s ? tick_s / constant_s : 1.0;
        position = position + share * (remote.pose->position - position);
    }
    put_there(world, situation.body, {position, sign * remote.pose->velocity});
}

void BaseAlgorithm::settle(scene::World& world, const Situation& situation,
                           const CombinedRemote& remote)
{
    const auto pose = at_rest_.pose(world.position(situation.body), remote, situation,
                                    {options_.settle_after, options_.settle_within});
    if (pose) put_there(world, situation.body, *pose);
}

void BaseAlgorithm::put_there(scene::World& world, scene::BodyId body,
                              CombinedRemote::Pose there) const
{
    if (options_.axes == Axes::x) {
        const scene::BodyState own = world.body(body);
        there.position.value = {there.position.x(), own.position.y(), own.position.z()};
        there.velocity.value = {there.velocity.x(), own.velocity.y(), own.velocity.z()};
    }
    world.place(body, there.position, there.velocity);
}

} // namespace hapnet::peer
