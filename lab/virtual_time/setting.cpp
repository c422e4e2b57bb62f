// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/setting.hpp"

#include "emulator/core/profile/timeline.hpp"
#include "peer/core/shared_body.hpp"
#include "scene/world.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

std::optional<std::string> objection(const Setting& setting)
{
    if (const auto body = peer::shared_body(setting.scene); !body) return body.error().message;
    const auto world = scene::World::freeze(setting.scene, {.tick = setting.tick});
    if (!world) return world.error().message;
    if (setting.length <= base::Duration{0}) return "a session lasts longer than 0 s";
    const bool are_phases = std::ranges::all_of(setting.players, [&](const PlayerSetting& player) {
        return player.phase >= base::Duration{0} && player.phase < setting.tick;
    });
    if (!are_phases) return "the phase of a player's ticks is 0 s to less than a tick";
    const bool are_traces = std::ranges::none_of(setting.players, [](const PlayerSetting& player) {
        return player.replay && player.replay->empty();
    });
    if (!are_traces) return "a hand's trace has at least one moment";
    if (const auto valid = emulator::Timeline::validate(setting.profile); !valid) {
        return fmt::format("change {} of the timeline: {}", valid.error().index + 1,
                           valid.error().message);
    }
    return std::nullopt;
}

} // namespace hapnet::lab
