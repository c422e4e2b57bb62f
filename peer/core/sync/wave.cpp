// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/wave.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::peer {

Wave::Wave(const WaveOptions& options)
    : options_{options},
      root_{std::sqrt(2.0 * options.impedance_ns_per_m)},
      wave_max_{2.0 * scene::force_max_n / root_}
{}

void Wave::prepare(std::size_t others)
{
    channels_.assign(others, Channel{});
    for (Channel& channel : channels_) channel.ring.assign(ring_max, Sent{});
}

void Wave::forget(std::size_t of)
{
    Channel& channel = channels_[of];
    channel.is_open = false;
    channel.incoming.reset();
    channel.oldest_of_use = channel.sent;
}

glm::dvec3 Wave::outgoing(const glm::dvec3& velocity, const glm::dvec3& incoming) const
{
    const glm::dvec3 wave = root_ * velocity - incoming;
    const double size = glm::length(wave);
    return size > wave_max_ ? (wave_max_ / size) * wave : wave;
}

/// Returns the wave that this copy sent in the message with that stamp; zero if the message is too
/// old.
glm::dvec3 Wave::sent_at(Channel& channel, base::TimePoint at) const
{
    std::uint64_t& index = channel.oldest_of_use;
    if (channel.sent > ring_max) index = std::max(index, channel.sent - ring_max);
    while (index < channel.sent && channel.ring[index % ring_max].at < at) ++index;
    if (index == channel.sent) return glm::dvec3{0.0};
    const Sent& found = channel.ring[index % ring_max];
    return found.at == at ? found.wave : glm::dvec3{0.0};
}

void Wave::hear(const ReceivedState& received)
{
    if (!received.taken) return;
    const wire::State& state = received.state;
    Channel& channel = channels_[received.from];
    // A wave that had reached the sender by its tick acted in that tick.
    glm::dvec3 theirs{0.0};
    if (state.echo && state.echo->age < received.tick) theirs = sent_at(channel, state.echo->of);
    const wire::BodyState* const body = state.bodies.first();
    const glm::dvec3 velocity = body != nullptr ? body->velocity.value : glm::dvec3{0.0};
    channel.is_open = true;
    channel.incoming = outgoing(velocity, theirs);
}

Outcome Wave::tick(scene::World& world, const Situation& situation)
{
    const CombinedRemote remote = combined_remote(situation, BaseOptions{});
    const glm::dvec3 velocity = world.velocity(situation.body).value;
    // A copy that is moved to the other's place sends no wave in answer. Otherwise the other's own
    // past velocity would return to it and drive it on.
    const bool is_closed = at_rest_.has_waited(situation.now);
    glm::dvec3 sum{0.0};
    for (Channel& channel : channels_) {
        if (is_closed) channel.incoming.reset();
        if (!channel.is_open || is_closed) continue;
        sum -= options_.impedance_ns_per_m * velocity;
        if (channel.incoming) sum += root_ * *channel.incoming;
    }
    if (sum != glm::dvec3{0.0}) world.push(situation.body, {sum});
    world.tick();
    Outcome outcome;
    outcome.touched = world.touch(own_hand);
    outcome.on_hand = outcome.touched.on_hand;
    outcome.remote_touching = remote.touching;
    outcome.remote_force = {sum};
    if (const auto& state = situation.remote.state()) outcome.remote_hip = state->hip;
    const glm::dvec3 after = world.velocity(situation.body).value;
    for (Channel& channel : channels_) {
        const glm::dvec3 incoming = channel.incoming.value_or(glm::dvec3{0.0});
        const glm::dvec3 wave = is_closed ? glm::dvec3{0.0} : outgoing(after, incoming);
        channel.ring[channel.sent++ % ring_max] = {situation.now, wave};
        channel.incoming.reset();
    }
    if (outcome.touched.touching || remote.touching) {
        at_rest_.interrupt();
    } else if (const auto pose = at_rest_.pose(world.position(situation.body), remote, situation)) {
        world.place(situation.body, pose->position, pose->velocity);
    }
    return outcome;
}

} // namespace hapnet::peer
