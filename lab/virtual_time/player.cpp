// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/player.hpp"

#include "device/page/page_hand.hpp"
#include "device/replay/replay.hpp"
#include "device/simulated/omni.hpp"
#include "peer/core/energy_budget.hpp"
#include "peer/core/shared_body.hpp"
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

/// Returns the roster of a player. In a pair, each accepts any peer that answers.
peer::Roster roster_of(const Setting& setting, const PlayerId& id)
{
    peer::Roster roster;
    if (setting.players.size() == 2) return roster;
    roster.others.clear();
    roster.wait_for = setting.wait_for;
    for (std::size_t seat = 0; seat < setting.players.size(); ++seat) {
        if (seat != id.seat) roster.others.push_back(static_cast<std::uint16_t>(seat + 1));
    }
    return roster;
}

peer::Settings settings_of(const Setting& setting, const PlayerId& id,
                           const device::Capabilities& capabilities)
{
    const PlayerSetting& player = setting.players.at(id.seat);
    peer::Settings settings;
    settings.scene = setting.scene;
    settings.algorithm = player.algorithm;
    settings.send = player.send;
    settings.playout = player.playout;
    settings.tick = setting.tick;
    settings.length = setting.length;
    settings.roster = roster_of(setting, id);
    settings.introduction = {.id = static_cast<std::uint16_t>(id.seat + 1),
                             .nonce = id.nonce,
                             .scene_hash = scene::hash(setting.scene),
                             .seed = player.seed.value_or(setting.seed).value(),
                             .tick_rate_hz = tick_rate_hz(setting.tick),
                             .task = wire::TaskName::from_text(name_of(setting.task)).value()};
    settings.introduction.hand = peer::hand_model_of(capabilities);
    if (const auto& within = player.clock.synchronised_within) {
        settings.introduction.clock = clock_hash(player.clock, "");
        settings.introduction.clock_error = *within;
    }
    return settings;
}

std::unique_ptr<device::Device> device_of(const Setting& setting, const PlayerId& id)
{
    const PlayerSetting& player = setting.players.at(id.seat);
    if (player.replay) return std::make_unique<device::Replay>(*player.replay, "a trace");
    if (player.page) return std::make_unique<device::PageHand>(player.page);
    return std::make_unique<device::SimulatedOmni>(
        device::Performer{.task = setting.task,
                          .options = setting.task_options,
                          .person = player.person,
                          .plant = player.omni,
                          .way = player.way});
}

/// Returns a secret that follows from two numbers. In virtual time nothing needs to be secret.
secure::Secret secret_of(std::uint64_t circle, std::uint64_t run)
{
    std::array<std::byte, 2 * sizeof(std::uint64_t)> text{};
    base::ByteWriter out{text};
    out.u64(circle);
    out.u64(run);
    const secure::Hash hash = secure::hash(text);
    return secure::Secret{std::span{hash}.first<secure::key_bytes>()};
}

/// Returns the keys of a circle, in the form of a key file for each of its members.
std::vector<secure::KeyFile> key_files(base::Seed circle, std::size_t players, bool shared)
{
    secure::prepare();
    secure::Entropy entropy{secret_of(circle.value(), 0)};
    auto files = secure::make_circle("virtual", static_cast<std::uint8_t>(players), entropy);
    if (!shared) {
        for (secure::KeyFile& file : files) file.pre_shared = secure::Secret{};
    }
    return files;
}

constexpr glm::dquat unturned{1.0, 0.0, 0.0, 0.0};

bool can_body_turn(const scene::Description& scene)
{
    const auto shared = peer::shared_body(scene);
    return shared && scene.bodies.at(*shared).turning != scene::Turning::locked;
}

peer::line::Line sealed_line(const secure::KeyFile& own, const secure::KeyFile::Member& other,
                             const PlayerId& id, base::Seed circle)
{
    secure::Association::Config config;
    config.own_id = own.id;
    config.other_id = other.id;
    config.circle = own.circle();
    config.run = id.nonce;
    config.place = place_of(other.id - std::size_t{1});
    // Each line of each run draws its own numbers: ids have 5 bits.
    const std::uint64_t run = std::uint64_t{id.nonce} << 10 | std::uint64_t{own.id} << 5 | other.id;
    return peer::line::Line{std::make_unique<peer::line::Sealed>(config, own.keys_with(other),
                                                                 secret_of(circle.value(), run))};
}

std::vector<peer::line::Line> lines_of(const Setting& setting, const PlayerId& id)
{
    const std::size_t count = setting.players.size();
    std::vector<peer::line::Line> lines;
    lines.reserve(count - 1);
    const PlayerSetting& player = setting.players.at(id.seat);
    if (const auto& circle = player.circle) {
        const auto files = key_files(*circle, count, player.has_shared_key);
        const secure::KeyFile& own = files.at(id.seat);
        for (const auto& other : own.others) lines.push_back(sealed_line(own, other, id, *circle));
        return lines;
    }
    for (std::size_t seat = 0; seat < count; ++seat) {
        if (seat != id.seat) lines.emplace_back(place_of(seat));
    }
    return lines;
}

} // namespace

device::Rig make_rig(const Setting& setting, const PlayerId& id)
{
    auto device = device_of(setting, id);
    device::GovernorLimits limits{.tick = setting.tick};
    if (setting.energy_limit) {
        limits.energy =
            peer::energy_budget(device->capabilities(), setting.players.at(id.seat).algorithm);
    }
    return {std::move(device), limits};
}

VirtualPlayer::VirtualPlayer(const Setting& setting, const PlayerId& id)
    : rig{make_rig(setting, id)},
      side{std::make_unique<peer::Side>(settings_of(setting, id, rig.device().capabilities()))},
      lines{lines_of(setting, id)},
      own_seat{id.seat},
      clock_ahead{setting.players.at(id.seat).clock_ahead},
      can_turn{can_body_turn(setting.scene)}
{}

void VirtualPlayer::step(base::TimePoint now)
{
    stepped_at = now;
    side->step(now + clock_ahead, rig);
    while (const auto notice = side->notice()) events.push_back(notice->event);
    const base::TimePoint here = now + clock_ahead;
    // Only one line per tick is tended, so there is at most one multiplication on the curve.
    if (++tended >= lines.size()) tended = 0;
    lines[tended].tick({here, (here + date_ahead).time_since_epoch().count()});
}

Sample VirtualPlayer::sample() const
{
    const peer::Tick& tick = side->tick();
    return {.body = peer().position(),
            .body_velocity = peer().velocity(),
            .orientation = can_turn ? peer().body().orientation : unturned,
            .hip = side->sample().hip,
            .hip_velocity = side->sample().velocity,
            .on_hand = side->told(),
            .on_body = tick.touched.on_body,
            .touching = tick.touched.touching,
            .holding = tick.touched.holding,
            .remote_touching = tick.remote_touching};
}

void VirtualPlayer::add_further_bodies(std::vector<Pose>& poses) const
{
    for (const peer::SharedBody& body : peer().shared().subspan(1)) {
        const scene::BodyState state = peer().world().body(body.id);
        poses.push_back({state.position, body.turns() ? state.orientation : unturned});
    }
}

} // namespace hapnet::lab::virtual_time
