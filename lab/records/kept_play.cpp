// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/kept_play.hpp"

#include "device/governor/limits_text.hpp"
#include "lab/virtual_time/world.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/version.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::lab::records {

namespace {

using namespace std::chrono_literals;
using virtual_time::VirtualPlayer;
using virtual_time::VirtualWorld;

constexpr base::Duration begins_in{60s};  // or never
constexpr base::Duration noted_every{1s}; // what two have agreed on
constexpr std::uint64_t tick_ns_of_records = 1'000'000;

nlohmann::json ids_but(std::size_t seat, std::size_t players)
{
    nlohmann::json ids = nlohmann::json::array();
    for (std::size_t other = 0; other < players; ++other) {
        if (other != seat) ids.push_back(other + 1);
    }
    return ids;
}

/// The head of the file, with the keys of a daemon's.
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
            {"scene_toml", scene::to_text(setting.scene)},
            {"scene_hash", fmt::format("{:016x}", scene::hash(setting.scene))},
            {"grip_damping_ns_per_m", usual.grip_damping_ns_per_m},
            {"algorithm", peer::name_of(player.algorithm)},
            {"algorithm_toml", peer::print_algorithm(player.algorithm)},
            {"governor_toml", device::print_limits(limits)},
            {"mount", {{"scale", 1.0}, {"offset_m", {0.0, 0.0, 0.0}}}},
            {"seed", player.seed.value_or(setting.seed).value()},
            {"device", player.replay ? "replay" : "sim"},
            {"duration_s", base::to_seconds(setting.length)},
            {"peers", ids_but(seat, setting.players.size())},
            {"wait_for", setting.wait_for},
            {"tick_ns", tick_ns_of_records},
            // One clock for all, as on one machine; no machine has it.
            {"boot_id", "virtual time"}};
}

/// The record of one player while it plays.
class Keeper {
public:
    Keeper(const VirtualPlayer& player, KeptRecord& kept) : player_{player}, kept_{kept} {}

    void on_message(const VirtualWorld::Arrival& arrival)
    {
        kept_.rows.push_back(
            record::MessageRow{.tick = tick_,
                               .received_at = arrival.at + player_.clock_ahead,
                               .from = static_cast<std::uint16_t>(arrival.from + 1),
                               .bytes{arrival.datagram.begin(), arrival.datagram.end()}});
    }

    /// After each of its ticks.
    void on_tick()
    {
        const base::TimePoint now = player_.stepped_at + player_.clock_ahead;
        kept_.rows.push_back(player_.side->row(tick_, {.due = now}));
        if (kept_.layout.has_bodies()) {
            for (const peer::SharedBody& body : player_.peer().shared())
                kept_.rows.push_back(player_.side->body_row(tick_, body));
        }
        noted_.resize(player_.peer().others().size());
        for (std::size_t other = 0; other < noted_.size(); ++other) note(other, now);
        ++tick_;
    }

private:
    void note(std::size_t other, base::TimePoint now)
    {
        const peer::Member& member = player_.peer().others()[other];
        const auto& session = member.session();
        const auto clock = player_.peer().clock(other);
        if (!session || !clock) return;
        auto& noted = noted_[other];
        const bool is_new =
            !noted || noted->session != session->number || noted->start != session->start;
        if (!is_new && now - noted->noted_at < noted_every) return;
        noted = record::SessionRow{.start = session->start,
                                   .length = player_.peer().length(),
                                   .remote_offset = clock->offset,
                                   .offset_uncertainty = clock->uncertainty,
                                   .session = session->number,
                                   .seed = session->seed,
                                   .other = member.id(),
                                   .noted_at = now,
                                   .remote_skew_ppm = clock->skew_ppm};
        kept_.rows.push_back(*noted);
    }

    const VirtualPlayer& player_;
    KeptRecord& kept_;
    std::uint64_t tick_ = 0;
    std::vector<std::optional<record::SessionRow>> noted_;
};

bool is_over(const VirtualWorld& world)
{
    for (std::size_t side = 0; side < world.sides(); ++side) {
        const peer::Phase phase = world.side(side).last().phase;
        if (phase != peer::Phase::ended && phase != peer::Phase::alone) return false;
    }
    return true;
}

} // namespace

base::Result<std::vector<KeptRecord>> play_and_keep(const virtual_time::Setting& setting)
{
    if (auto valid = validate(setting); !valid) return tl::unexpected{std::move(valid).error()};
    const auto is_sealed = [](const auto& player) { return player.circle.has_value(); };
    if (std::ranges::any_of(setting.players, is_sealed))
        return base::fail("a record holds messages without keys: use keyed = false");
    if (setting.tick != 1ms) return base::fail("a record has ticks of 1 ms: use tick = \"1ms\"");
    VirtualWorld world{setting};
    std::vector<KeptRecord> kept(world.sides());
    std::vector<Keeper> keepers;
    for (std::size_t side = 0; side < world.sides(); ++side) {
        const VirtualPlayer& player = world.side(side);
        kept[side].config = kept_config(setting, side, player.rig.governor().limits());
        if (!peer::is_one_without_turning(player.peer().shared()))
            kept[side].layout = kept[side].layout.with_bodies();
        keepers.emplace_back(player, kept[side]);
    }
    world.intercept([&](const VirtualWorld::Arrival& arrival) {
        keepers[arrival.to].on_message(arrival);
        const std::size_t line = arrival.from < arrival.to ? arrival.from : arrival.from - 1;
        world.side(arrival.to).receive(line, arrival.datagram, arrival.at);
    });
    const base::TimePoint latest = VirtualWorld::start + begins_in + setting.length;
    while (!is_over(world) && world.now() < latest) {
        world.step();
        for (std::size_t side = 0; side < world.sides(); ++side) {
            if (world.side(side).stepped_at == world.now()) keepers[side].on_tick();
        }
    }
    if (!is_over(world)) return base::fail("a session to be recorded never began");
    return kept;
}

} // namespace hapnet::lab::records
