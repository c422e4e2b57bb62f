// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/presence.hpp"

namespace hapnet::peer {

Presence presence_of(const Situation& situation, const BaseOptions& options)
{
    Presence presence;
    const Remote& remote = situation.remote;
    if (const auto& body = remote.body()) {
        presence.pose = Presence::Pose{body->position, body->velocity};
    }
    const auto& state = remote.state();
    if (!(situation.freshness > 0.0) || !state) return presence;
    const auto& let_go_after = options.let_go_after;
    presence.heard = !let_go_after || situation.now - *remote.arrived() <= *let_go_after;
    presence.touching = presence.heard && state->touching;
    if (presence.touching) {
        const base::Force force = base::limited(state->contact_force, situation.force_max_n);
        presence.force = situation.freshness * along(force, options.axes);
    }
    return presence;
}

base::Force along(base::Force force, Axes axes)
{
    return axes == Axes::all ? force : base::Force{{force.x(), 0.0, 0.0}};
}

} // namespace hapnet::peer
