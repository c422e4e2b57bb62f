// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/combined_remote.hpp"

namespace hapnet::peer {

namespace {

/// Adds one of the others to the combined remote.
void add(CombinedRemote& combined, const Remote& remote, const Situation& situation,
         const BaseOptions& options)
{
    const auto& state = remote.state();
    if (!(remote.freshness() > 0.0) || !state) return;
    const auto& let_go_after = options.let_go_after;
    if (let_go_after && situation.now - *remote.arrived() > *let_go_after) return;
    combined.heard = true;
    if (!state->touching) return;
    const base::Force limited = base::limited(state->contact_force, situation.force_max_n);
    const base::Force force = remote.freshness() * along(limited, options.axes);
    combined.force = combined.touching ? combined.force + force : force;
    combined.touching = true;
}

/// Returns the average of the poses that the touching peers have for the body. If no hand touches
/// it, returns the pose that `remote` has.
std::optional<CombinedRemote::Pose> pose_of(const Situation& situation, bool touching)
{
    if (situation.others.size() > 1 && touching) {
        double count = 0.0;
        CombinedRemote::Pose sum{};
        for (const Remote& other : situation.others) {
            const auto& state = other.state();
            const wire::BodyState* const body = other.body();
            if (!(other.freshness() > 0.0) || !state || !state->touching || !body) continue;
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
    return CombinedRemote::Pose{body->position, body->velocity};
}

} // namespace

CombinedRemote combined_remote(const Situation& situation, const BaseOptions& options)
{
    CombinedRemote combined;
    for (const Remote& other : situation.others) add(combined, other, situation, options);
    combined.pose = pose_of(situation, combined.touching);
    return combined;
}

base::Force along(base::Force force, Axes axes)
{
    return axes == Axes::all ? force : base::Force{{force.x(), 0.0, 0.0}};
}

} // namespace hapnet::peer
