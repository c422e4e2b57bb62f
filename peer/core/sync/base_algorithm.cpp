// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/base_algorithm.hpp"

#include "peer/core/shared_body.hpp"

#include <algorithm>

namespace hapnet::peer {

bool remote_touching(const Situation& situation)
{
    const auto& state = situation.remote.state();
    return situation.freshness > 0.0 && state && state->touching;
}

base::Force remote_force(const Situation& situation, double force_max_n)
{
    if (!remote_touching(situation)) return {};
    return situation.freshness *
           base::limited(situation.remote.state()->contact_force, force_max_n);
}

scene::HipTouch BaseAlgorithm::tick(scene::World& world, const Situation& situation,
                                    base::Force from_remote)
{
    const bool remote_touches = remote_touching(situation);
    if (remote_touches) world.push(situation.body, from_remote);
    world.tick();
    const scene::HipTouch own = world.touch(own_hand);
    if (own.touching || remote_touches) {
        untouched_since_.reset();
        blend_.reset();
    }
    const auto& heard = situation.remote.body();
    if (own.touching) return own;
    if (remote_touches && heard) {
        put(world, situation.body, heard->position, heard->velocity);
    } else {
        settle(world, situation);
    }
    return own;
}

void BaseAlgorithm::settle(scene::World& world, const Situation& situation)
{
    if (!untouched_since_) untouched_since_ = situation.now;
    const auto& heard = situation.remote.body();
    const bool waited = situation.now - *untouched_since_ >= settle_after;
    if (!situation.yields || !waited || !heard || situation.freshness <= 0.0) {
        blend_.reset();
        return;
    }
    if (!blend_) blend_ = Blend{situation.now, world.body(situation.body).position};
    const double share = std::min(1.0, base::to_seconds(situation.now - blend_->start) /
                                           base::to_seconds(settle_within));
    put(world, situation.body, blend_->from + share * (heard->position - blend_->from),
        heard->velocity);
}

} // namespace hapnet::peer
