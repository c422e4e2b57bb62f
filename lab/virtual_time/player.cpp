// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/player.hpp"

#include "device/replay/replay.hpp"
#include "device/simulated/omni.hpp"

#include <algorithm>

namespace hapnet::lab {

namespace {

std::uint16_t tick_rate_hz(base::Duration tick)
{
    const auto rate = std::chrono::nanoseconds{std::chrono::seconds{1}} / tick;
    return static_cast<std::uint16_t>(std::min<base::Duration::rep>(rate, UINT16_MAX));
}

peer::Settings settings_of(const Setting& setting, const Seat& seat)
{
    const PlayerSetting& player = setting.players.at(seat.side);
    peer::Settings settings;
    settings.scene = setting.scene;
    settings.algorithm = player.algorithm;
    settings.tick = setting.tick;
    settings.length = setting.length;
    settings.introduction = {.id = static_cast<std::uint16_t>(seat.side + 1),
                             .nonce = seat.nonce,
                             .scene_hash = scene::hash(setting.scene),
                             .seed = player.seed.value_or(setting.seed).value(),
                             .tick_rate_hz = tick_rate_hz(setting.tick),
                             .task = wire::TaskName::from_text(name_of(setting.task)).value()};
    return settings;
}

std::unique_ptr<device::Device> device_of(const Setting& setting, const Seat& seat)
{
    const PlayerSetting& player = setting.players.at(seat.side);
    if (player.replay) return std::make_unique<device::Replay>(*player.replay, "a trace");
    return std::make_unique<device::SimulatedOmni>(device::Performer{
        .task = setting.task, .options = setting.task_options, .person = player.person});
}

} // namespace

VirtualPlayer::VirtualPlayer(const Setting& setting, const Seat& seat)
    : rig{device_of(setting, seat), {.tick = setting.tick}},
      peer{std::make_unique<peer::Peer>(settings_of(setting, seat))},
      clock_ahead{setting.players.at(seat.side).clock_ahead},
      id{static_cast<std::uint16_t>(seat.side + 1)}
{}

void VirtualPlayer::turn(base::TimePoint now)
{
    turned = now;
    const base::TimePoint here = now + clock_ahead;
    hand = rig.read(here);
    last = peer->tick(here, {hand.hip, hand.velocity, hand.gripping, is_in_hand(hand)});
    applied = rig.apply(last.force, last.permitted, here);
    while (const auto event = peer->event()) events.push_back(*event);
    const auto& session = peer->session();
    if (session && cued != session->start) {
        cued = session->start;
        rig.device().on_cue(
            {session->start, peer->hands_on(), base::Seed{session->seed}, id, session->is_left});
    }
}

Sample VirtualPlayer::sample() const
{
    return {.body = peer->position(),
            .body_velocity = peer->velocity(),
            .hip = hand.hip,
            .hip_velocity = hand.velocity,
            .on_hand = applied,
            .on_body = last.touched.on_body,
            .touching = last.touched.touching,
            .holding = last.touched.holding,
            .remote_touching = last.remote_touching};
}

} // namespace hapnet::lab
