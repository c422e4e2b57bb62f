// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/base_algorithm.hpp"

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

void BaseAlgorithm::tick(Cube& cube, const Situation& situation, base::Force from_remote)
{
    const bool remote_touches = remote_touching(situation);
    if (situation.local.touching || remote_touches) {
        untouched_since_.reset();
        blend_.reset();
    }
    const auto& body = situation.remote.body();
    if (situation.local.touching) {
        cube.step(situation.local.on_cube + from_remote);
    } else if (remote_touches && body) {
        cube.place(body->position, body->velocity);
    } else {
        settle(cube, situation);
    }
}

void BaseAlgorithm::settle(Cube& cube, const Situation& situation)
{
    if (!untouched_since_) untouched_since_ = situation.now;
    const auto& body = situation.remote.body();
    const bool waited = situation.now - *untouched_since_ >= settle_after;
    if (!situation.yields || !waited || !body || situation.freshness <= 0.0) {
        blend_.reset();
        cube.step({});
        return;
    }
    if (!blend_) blend_ = Blend{situation.now, cube.position()};
    const double share = std::min(1.0, base::to_seconds(situation.now - blend_->start) /
                                           base::to_seconds(settle_within));
    cube.place(blend_->from + share * (body->position - blend_->from), body->velocity);
}

} // namespace hapnet::peer
