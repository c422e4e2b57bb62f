// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/base_bodies.hpp"

#include "peer/core/sync/shared_poses.hpp"

#include <glm/geometric.hpp>

namespace hapnet::peer {

namespace {

/// Returns the touching hands without those that count as off after a silence.
SharedPoses::Touchers touchers_of(const Situation& situation, const BaseOptions& options)
{
    SharedPoses::Touchers touchers = situation.poses->touchers(situation);
    if (!options.let_go_after) return touchers;
    std::size_t kept = 0;
    for (const SharedPoses::Toucher& toucher : touchers.list())
        if (situation.now - *toucher.other->arrived() <= *options.let_go_after)
            touchers.all[kept++] = toucher;
    touchers.count = kept;
    return touchers;
}

/// Applies the forces of the others' hands to the bodies, as they were last heard. They fade with
/// age. None exceeds the greatest force of a contact, and no lever is longer than the body.
void push(scene::World& world, const Situation& situation, const SharedPoses::Touchers& touchers,
          Outcome& outcome)
{
    for (const SharedPoses::Toucher& toucher : touchers.list()) {
        const wire::State& state = *toucher.other->state();
        const wire::BodyState& body = *toucher.other->touched();
        const base::Force force =
            toucher.other->freshness() * base::limited(state.contact_force, situation.force_max_n);
        world.push(body.body, force);
        outcome.remote_force += force;
        outcome.remote_touching = true;
        const SharedBody& shared = situation.poses->bodies()[toucher.body];
        if (!shared.turns()) continue;
        const double lever_max_m = shared.reach_m + world.frozen().hands.radius_m;
        const base::Displacement lever = base::limited(state.hip - body.position, lever_max_m);
        world.push_torque(body.body, glm::cross(lever.value, force.value));
    }
}

} // namespace

Outcome tick_bodies(scene::World& world, const Situation& situation, const BaseOptions& options)
{
    SharedPoses& poses = *situation.poses;
    const SharedPoses::Touchers touchers = touchers_of(situation, options);
    Outcome outcome;
    push(world, situation, touchers, outcome);
    world.tick();
    const scene::HandTouch& own = world.touch(own_hand);
    outcome.touched = own;
    outcome.on_hand = own.on_hand;
    if (const auto& state = situation.remote.state()) outcome.remote_hip = state->hip;
    poses.find_movers(world, situation, touchers);
    for (std::size_t i = 0; i < poses.bodies().size(); ++i) {
        if (poses.mover(i) == SharedPoses::Mover::none) poses.settle(world, situation, i);
        if (poses.mover(i) == SharedPoses::Mover::others)
            poses.follow(world, situation, i, *poses.mover_among(touchers, i)->other);
    }
    return outcome;
}

} // namespace hapnet::peer
