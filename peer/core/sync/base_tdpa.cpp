// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/base_tdpa.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hapnet::peer {

void BaseTdpa::hear(const ReceivedState& received)
{
    base_.hear(received);
    if (!received.taken) return;
    auto& work_uj = work_uj_[received.from];
    const std::uint32_t now_uj = received.state.work_uj;
    observed_j_ += 1e-6 * static_cast<std::int32_t>(now_uj - work_uj.value_or(now_uj));
    work_uj = now_uj;
}

void BaseTdpa::forget(std::size_t of)
{
    base_.forget();
    work_uj_[of].reset();
}

/// Returns the damping force that takes out the excess of energy with which this tick would end. It
/// does not exceed the greatest force of a contact, and its damping is less than would reverse the
/// body within two ticks.
base::Force BaseTdpa::damping_force(base::Force remote, base::Velocity velocity, double mass_kg,
                                    const Situation& situation) const
{
    const double tick_s = base::to_seconds(situation.tick);
    const double left_j = observed_j_ - tick_s * glm::dot(remote.value, velocity.value);
    const double square = glm::dot(velocity.value, velocity.value);
    if (left_j >= 0.0 || !(square > 0.0)) return {};
    const double most = std::min(options_.damping_max_ns_per_m, 0.5 * mass_kg / tick_s);
    const double damping = std::min(-left_j / (square * tick_s), most);
    return base::limited(base::Force{-damping * velocity.value}, situation.force_max_n);
}

Outcome BaseTdpa::tick(scene::World& world, const Situation& situation)
{
    CombinedRemote remote = combined_remote(situation, options_.base);
    const base::Position before = world.position(situation.body);
    const base::Velocity velocity = world.velocity(situation.body);
    const scene::Bodies& bodies = world.state().bodies;
    const double mass_kg = bodies.properties[bodies.slot_of[situation.body]].mass;
    if (remote.touching) {
        const base::Force damping = damping_force(remote.force, velocity, mass_kg, situation);
        remote.force = remote.force + along(damping, options_.base.axes);
    }
    const Outcome outcome = base_.tick(world, situation, remote);
    if (!outcome.touched.touching) {
        follows_ = remote.touching;
        return outcome;
    }
    // The body comes to this hand with the kinetic energy that others gave it.
    if (follows_) observed_j_ -= 0.5 * mass_kg * glm::dot(velocity.value, velocity.value);
    follows_ = false;
    const base::Displacement moved = world.position(situation.body) - before;
    observed_j_ -= glm::dot(outcome.remote_force.value, moved.value);
    return outcome;
}

} // namespace hapnet::peer
