// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/setting.hpp"

#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/paths.hpp"
#include "peer/core/others.hpp"
#include "peer/core/shared_body.hpp"
#include "peer/core/sync/text.hpp"
#include "scene/world.hpp"

#include <algorithm>
#include <functional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::virtual_time {

namespace {

base::Result<void> validate_number(const Setting& setting)
{
    const std::size_t count = setting.players.size();
    if (count < 2 || count > peer::peers_max) {
        return base::fail(fmt::format("{} players: a session has 2 to {}", count, peer::peers_max));
    }
    if (setting.wait_for > count) {
        return base::fail(fmt::format("{} are waited for, and {} play", setting.wait_for, count));
    }
    if (count > setting.scene.hands.count) {
        return base::fail(fmt::format("the scene '{}' has {} hands, and {} play: choose another "
                                      "scene, such as carry, or raise count in its [hips]",
                                      setting.scene.name, setting.scene.hands.count, count));
    }
    const auto plays = [](const PlayerSetting& player) {
        return peer::plays_with_many(player.algorithm);
    };
    const auto other = std::ranges::find_if_not(setting.players, plays);
    if (count > 2 && other != setting.players.end()) {
        return base::fail(fmt::format("{} is made for two, and {} play: use base or remote-proxy, "
                                      "as in algorithms = \"base\"",
                                      peer::name_of(other->algorithm), count));
    }
    return {};
}

base::Result<void> validate_network(const Setting& setting)
{
    if (!setting.profile.flows.empty()) {
        return base::fail("the profile has flows, and messages in virtual time have neither "
                          "addresses nor ports: leave out [[flow]]");
    }
    const auto links = links_between(setting.players.size());
    const emulator::PathNames names{.links =
                                        links.size() == 1 ? std::vector<std::string>{} : links};
    for (const std::string& path : emulator::paths_in(setting.profile)) {
        if (names.contains(path)) continue;
        if (links.size() > 1) return base::fail(names.refusal(path));
        return base::fail(
            fmt::format("there is no link {} between two: use both, up or down", path));
    }
    if (const auto valid = emulator::validate_timelines(setting.profile); !valid) {
        const auto& [index, message] = valid.error();
        return base::fail(fmt::format("change {} of the timeline: {}", index + 1, message));
    }
    return {};
}

} // namespace

Setting in_one_world(Setting setting)
{
    setting.is_one_world = true;
    setting.profile = {};
    setting.wait_for = 0;
    for (PlayerSetting& player : setting.players) {
        PlayerSetting same;
        same.person = player.person;
        same.omni = player.omni;
        same.replay = player.replay;
        same.page = player.page;
        same.way = player.way;
        player = std::move(same);
    }
    return setting;
}

std::vector<std::string> links_between(std::size_t players)
{
    if (players == 2) return {""};
    std::vector<std::string> names;
    for (std::size_t a = 1; a < players; ++a) {
        for (std::size_t b = a + 1; b <= players; ++b) names.push_back(fmt::format("{}-{}", a, b));
    }
    return names;
}

base::Result<void> validate(const Setting& setting)
{
    if (auto number = validate_number(setting); !number) return number;
    const auto bodies = peer::shared_bodies(setting.scene);
    if (!bodies) return tl::unexpected{bodies.error()};
    for (const PlayerSetting& player : setting.players) {
        if (const auto fine = peer::check_bodies_of(player.algorithm, *bodies); !fine)
            return tl::unexpected{fine.error()};
        if (const auto fine = peer::check_hands_of(player.algorithm, setting.scene.hands); !fine)
            return tl::unexpected{fine.error()};
    }
    if (auto world = scene::World::freeze(setting.scene, {.tick = setting.tick}); !world) {
        return tl::unexpected{std::move(world).error()};
    }
    if (setting.length <= base::Duration{0}) return base::fail("a session must be longer than 0 s");
    const bool are_phases = std::ranges::all_of(setting.players, [&](const PlayerSetting& player) {
        return player.phase >= base::Duration{0} && player.phase < setting.tick;
    });
    if (!are_phases) {
        return base::fail(
            "the phase of a player's ticks must be at least 0 s and less than a tick");
    }
    const bool are_ascending = std::ranges::all_of(setting.players, [](const auto& player) {
        if (!player.ticks) return true;
        return std::ranges::adjacent_find(*player.ticks, std::ranges::greater_equal{}) ==
               player.ticks->end();
    });
    if (!are_ascending) return base::fail("the ticks of a player must follow one another");
    const bool are_traces = std::ranges::none_of(setting.players, [](const PlayerSetting& player) {
        return (player.replay && player.replay->empty()) || (player.way && player.way->empty());
    });
    if (!are_traces) return base::fail("a hand's trace must have at least one row");
    return validate_network(setting);
}

} // namespace hapnet::lab::virtual_time
