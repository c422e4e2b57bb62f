// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/setting.hpp"

#include "emulator/core/profile/timeline.hpp"
#include "peer/core/shared_body.hpp"
#include "scene/world.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::virtual_time {

base::Result<void> validate(const Setting& setting)
{
    const auto bodies = peer::shared_bodies(setting.scene);
    if (!bodies) return tl::unexpected{bodies.error()};
    for (const PlayerSetting& player : setting.players) {
        if (const auto fine = peer::check_bodies_of(player.algorithm, *bodies); !fine)
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
    const bool are_traces = std::ranges::none_of(setting.players, [](const PlayerSetting& player) {
        return player.replay && player.replay->empty();
    });
    if (!are_traces) return base::fail("a hand's trace must have at least one row");
    if (const auto valid = emulator::Timeline::validate(setting.profile); !valid) {
        const auto& [index, message] = valid.error();
        return base::fail(fmt::format("change {} of the timeline: {}", index + 1, message));
    }
    return {};
}

} // namespace hapnet::lab::virtual_time
