// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/player.hpp"

#include "device/replay/replay.hpp"
#include "device/simulated/omni.hpp"
#include "peer/core/energy_budget.hpp"
#include "proto/base/bytes.hpp"
#include "proto/secure/key_file.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::lab::virtual_time {

namespace {

std::uint16_t tick_rate_hz(base::Duration tick)
{
    const auto rate = std::chrono::nanoseconds{std::chrono::seconds{1}} / tick;
    return static_cast<std::uint16_t>(std::min<base::Duration::rep>(rate, UINT16_MAX));
}

peer::Settings settings_of(const Setting& setting, const PlayerId& id,
                           const device::Capabilities& capabilities)
{
    const PlayerSetting& player = setting.players.at(id.side);
    peer::Settings settings;
    settings.scene = setting.scene;
    settings.algorithm = player.algorithm;
    settings.tick = setting.tick;
    settings.length = setting.length;
    settings.introduction = {.id = static_cast<std::uint16_t>(id.side + 1),
                             .nonce = id.nonce,
                             .scene_hash = scene::hash(setting.scene),
                             .seed = player.seed.value_or(setting.seed).value(),
                             .tick_rate_hz = tick_rate_hz(setting.tick),
                             .task = wire::TaskName::from_text(name_of(setting.task)).value()};
    settings.introduction.hand = peer::hand_model_of(capabilities);
    return settings;
}

std::unique_ptr<device::Device> device_of(const Setting& setting, const PlayerId& id)
{
    const PlayerSetting& player = setting.players.at(id.side);
    if (player.replay) return std::make_unique<device::Replay>(*player.replay, "a trace");
    return std::make_unique<device::SimulatedOmni>(device::Performer{
        .task = setting.task, .options = setting.task_options, .person = player.person});
}

device::Rig rig_of(const Setting& setting, const PlayerId& id)
{
    auto device = device_of(setting, id);
    device::GovernorLimits limits{.tick = setting.tick};
    if (setting.energy_limit) {
        limits.energy =
            peer::energy_budget(device->capabilities(), setting.players.at(id.side).algorithm);
    }
    return {std::move(device), limits};
}

/// A secret that follows from two numbers: in virtual time nothing has to be kept from anybody.
secure::Secret secret_of(std::uint64_t circle, std::uint64_t run)
{
    std::array<std::byte, 2 * sizeof(std::uint64_t)> text{};
    base::ByteWriter out{text};
    out.u64(circle);
    out.u64(run);
    const secure::Hash hash = secure::hash(text);
    return secure::Secret{std::span{hash}.first<secure::key_bytes>()};
}

peer::line::Line line_of(const Setting& setting, const PlayerId& id)
{
    const std::size_t other = 1 - id.side;
    const auto& circle = setting.players.at(id.side).circle;
    if (!circle) return peer::line::Line{place_of(other)};
    secure::prepare();
    secure::Entropy entropy{secret_of(circle->value(), 0)};
    const auto files = secure::make_circle("virtual", 2, entropy);
    const secure::KeyFile& own = files.at(id.side);
    secure::Association::Config config;
    config.own_id = own.id;
    config.other_id = own.others.front().id;
    config.circle = own.circle();
    config.run = id.nonce;
    config.place = place_of(other);
    auto seed = secret_of(circle->value(), std::uint64_t{id.nonce} << 1 | id.side);
    return peer::line::Line{std::make_unique<peer::line::Sealed>(
        config, own.keys_with(own.others.front()), std::move(seed))};
}

} // namespace

secure::Place place_of(std::size_t side)
{
    secure::Place place{};
    place.front() = static_cast<std::byte>(side % 2 + 1);
    return place;
}

VirtualPlayer::VirtualPlayer(const Setting& setting, const PlayerId& id)
    : rig{rig_of(setting, id)},
      side{std::make_unique<peer::Side>(settings_of(setting, id, rig.device().capabilities()))},
      line{line_of(setting, id)},
      other_place{place_of(1 - id.side)},
      clock_ahead{setting.players.at(id.side).clock_ahead}
{}

void VirtualPlayer::step(base::TimePoint now)
{
    stepped_at = now;
    side->step(now + clock_ahead, rig);
    while (const auto notice = side->notice()) events.push_back(notice->event);
    const base::TimePoint here = now + clock_ahead;
    line.tick({here, (here + date_ahead).time_since_epoch().count()});
}

Sample VirtualPlayer::sample() const
{
    const peer::Tick& tick = side->tick();
    return {.body = peer().position(),
            .body_velocity = peer().velocity(),
            .hip = side->sample().hip,
            .hip_velocity = side->sample().velocity,
            .on_hand = side->told(),
            .on_body = tick.touched.on_body,
            .touching = tick.touched.touching,
            .holding = tick.touched.holding,
            .remote_touching = tick.remote_touching};
}

} // namespace hapnet::lab::virtual_time
