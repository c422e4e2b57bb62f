// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/kept_play.hpp"

#include "device/governor/limits_text.hpp"
#include "emulator/core/profile/text.hpp"
#include "lab/virtual_time/journal.hpp"
#include "lab/virtual_time/world.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/version.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::lab::records {

namespace {

using namespace std::chrono_literals;
using virtual_time::VirtualPlayer;
using virtual_time::VirtualWorld;

constexpr base::Duration begins_in{60s}; // a session that has not begun by then never does
constexpr std::uint64_t tick_ns_of_records = 1'000'000;

nlohmann::json ids_but(std::size_t seat, std::size_t players)
{
    nlohmann::json ids = nlohmann::json::array();
    for (std::size_t other = 0; other < players; ++other) {
        if (other != seat) ids.push_back(other + 1);
    }
    return ids;
}

/// Returns the head of the file, with the keys that a daemon writes.
nlohmann::json kept_config(const virtual_time::Setting& setting, std::size_t seat,
                           const device::GovernorLimits& limits)
{
    const virtual_time::PlayerSetting& player = setting.players.at(seat);
    const peer::Settings usual;
    return {{"program", "hapnet-lab"},
            {"version", base::version()},
            {"commit", base::commit()},
            {"compiler", base::compiler()},
            {"peer_id", seat + 1},
            {"nonce", 100 + seat},
            {"task", name_of(setting.task)},
            {"network_toml", emulator::to_text(setting.profile)},
            {"scene_toml", scene::to_text(setting.scene)},
            {"scene_hash", fmt::format("{:016x}", scene::hash(setting.scene))},
            {"grip_damping_ns_per_m", usual.grip_damping_ns_per_m},
            {"algorithm", peer::name_of(player.algorithm)},
            {"algorithm_toml", peer::print_algorithm(player.algorithm)},
            {"send", text_of(player.send)},
            {"playout", base::name_of(player.playout)},
            {"clock", text_of(player.clock)},
            {"governor_toml", device::print_limits(limits)},
            {"mount", {{"scale", 1.0}, {"offset_m", {0.0, 0.0, 0.0}}}},
            {"seed", player.seed.value_or(setting.seed).value()},
            {"device", player.replay ? "replay" : "sim"},
            {"duration_s", base::to_seconds(setting.length)},
            {"peers", ids_but(seat, setting.players.size())},
            {"wait_for", setting.wait_for},
            {"tick_ns", tick_ns_of_records},
            // All players have one clock, as on one machine. No real machine has this id.
            {"boot_id", "virtual time"}};
}

bool is_over(const VirtualWorld& world)
{
    for (std::size_t side = 0; side < world.sides(); ++side) {
        const peer::Phase phase = world.side(side).last().phase;
        if (phase != peer::Phase::ended && phase != peer::Phase::alone) return false;
    }
    return true;
}

/// Returns the smallest layout that has room for these rows.
record::Layout layout_for(const std::vector<record::Row>& rows, bool has_bodies)
{
    std::size_t longest = 0;
    for (const record::Row& row : rows) {
        if (const auto* message = std::get_if<record::MessageRow>(&row))
            longest = std::max(longest, message->bytes.size());
    }
    const auto layout = record::Layout::for_messages_of(longest);
    return has_bodies ? layout.with_bodies() : layout;
}

} // namespace

base::Result<std::vector<KeptRecord>> play_and_keep(const virtual_time::Setting& setting)
{
    if (auto valid = validate(setting); !valid) return tl::unexpected{std::move(valid).error()};
    const auto is_sealed = [](const auto& player) { return player.circle.has_value(); };
    if (std::ranges::any_of(setting.players, is_sealed))
        return base::fail("a record holds messages without keys: use keyed = false");
    const auto is_apart = [](const auto& player) { return player.clock != peer::ClockPolicy{}; };
    if (std::ranges::any_of(setting.players, is_apart))
        return base::fail("a record in virtual time has one clock: use clock = \"echo\"");
    if (setting.tick != 1ms) return base::fail("a record has ticks of 1 ms: use tick = \"1ms\"");
    VirtualWorld world{setting};
    std::vector<KeptRecord> kept(world.sides());
    std::vector<virtual_time::Journal> journals;
    for (std::size_t side = 0; side < world.sides(); ++side) {
        const VirtualPlayer& player = world.side(side);
        kept[side].config = kept_config(setting, side, player.rig.governor().limits());
        journals.emplace_back(
            player, [&record = kept[side]](const record::Row& row) { record.rows.push_back(row); });
    }
    world.intercept([&](const VirtualWorld::Arrival& arrival) {
        journals[arrival.to].on_message(arrival.from, arrival);
        const std::size_t line = arrival.from < arrival.to ? arrival.from : arrival.from - 1;
        world.side(arrival.to).receive(line, arrival.datagram, arrival.at);
    });
    const base::TimePoint latest = VirtualWorld::start + begins_in + setting.length;
    while (!is_over(world) && world.now() < latest) {
        world.step();
        for (std::size_t side = 0; side < world.sides(); ++side) {
            if (world.side(side).stepped_at == world.now()) journals[side].on_tick();
        }
    }
    if (!is_over(world)) return base::fail("a session to be recorded never began");
    for (std::size_t side = 0; side < world.sides(); ++side) {
        kept[side].layout = layout_for(kept[side].rows, journals[side].has_bodies());
    }
    return kept;
}

} // namespace hapnet::lab::records
