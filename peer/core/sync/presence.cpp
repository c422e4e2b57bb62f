// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/presence.hpp"

namespace hapnet::peer {

namespace {

/// Adds one of the others to those before it.
void add(Presence& presence, const Other& other, const Situation& situation,
         const BaseOptions& options)
{
    const Remote& remote = *other.remote;
    const auto& state = remote.state();
    if (!(other.freshness > 0.0) || !state) return;
    const auto& let_go_after = options.let_go_after;
    if (let_go_after && situation.now - *remote.arrived() > *let_go_after) return;
    presence.heard = true;
    if (!state->touching) return;
    const base::Force limited = base::limited(state->contact_force, situation.force_max_n);
    const base::Force force = other.freshness * along(limited, options.axes);
    presence.force = presence.touching ? presence.force + force : force;
    presence.touching = true;
}

/// Where those who touch have the body, on average; nobody touches it: where `remote` has it.
std::optional<Presence::Pose> pose_of(const Situation& situation, bool touching)
{
    if (situation.others.size() > 1 && touching) {
        double count = 0.0;
        Presence::Pose sum{};
        for (const Other& other : situation.others) {
            const auto& state = other.remote->state();
            const wire::BodyState* const body = other.remote->body();
            if (!(other.freshness > 0.0) || !state || !state->touching || !body) continue;
            sum.position.value += body->position.value;
            sum.velocity.value += body->velocity.value;
            count += 1.0;
        }
        if (count > 0.0) {
            sum.position.value /= count;
            sum.velocity.value /= count;
            return sum;
        }
    }
    const wire::BodyState* const body = situation.remote.body();
    if (!body) return std::nullopt;
    return Presence::Pose{body->position, body->velocity};
}

} // namespace

Presence presence_of(const Situation& situation, const BaseOptions& options)
{
    Presence presence;
    for (const Other& other : situation.others) add(presence, other, situation, options);
    presence.pose = pose_of(situation, presence.touching);
    return presence;
}

base::Force along(base::Force force, Axes axes)
{
    return axes == Axes::all ? force : base::Force{{force.x(), 0.0, 0.0}};
}

} // namespace hapnet::peer
