// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/daemons.hpp"

#include "emulator/core/profile/text.hpp"
#include "peer/core/sync/text.hpp"
#include "scene/text/text.hpp"

#include <array>
#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <variant>

namespace hapnet::lab::experiment {

namespace {

using namespace std::chrono_literals;

/// A feature of an experiment that the daemons do not have.
struct Obstacle {
    bool is_there = false;
    std::string_view what;
};

base::Result<void> check(const Experiment& experiment)
{
    const std::array obstacles{
        Obstacle{std::holds_alternative<Limits>(experiment.kind),
                 "a search of limits chooses its levels by what it has played; write them down as "
                 "kind = \"plane\""},
        Obstacle{experiment.tick != 1ms, "their tick is 1 ms; leave 'tick' out"},
        Obstacle{experiment.duration % 1s != 0s, "'duration' has to be whole seconds"},
        Obstacle{experiment.clock != peer::ClockPolicy{}, "leave 'clock' out: here is one clock"},
        Obstacle{experiment.device != device::OmniPlant{},
                 "leave 'device' out: the daemons' devices are those of the data sheet"},
        Obstacle{experiment.keyed, "leave 'keyed' out: this plays without keys"},
        Obstacle{experiment.task_options != device::TaskOptions{}, "leave 'task_options' out"},
        Obstacle{!experiment.replay.empty(), "leave 'replay' out: hands are simulated"},
        Obstacle{experiment.hands.people != nullptr,
                 "leave recorded 'hands' out: hands are simulated"},
        Obstacle{!experiment.script.empty(), "leave 'script' out: hands do what the task says"}};
    for (const Obstacle& obstacle : obstacles) {
        if (obstacle.is_there)
            return base::fail("the daemons cannot play this: " + std::string{obstacle.what});
    }
    return {};
}

} // namespace

base::Result<std::vector<SessionJob>> daemon_sessions(const Experiment& experiment)
{
    if (auto fine = check(experiment); !fine) return tl::unexpected{fine.error()};
    std::vector<SessionJob> sessions;
    for (Job& job : make_jobs(experiment)) {
        auto* one = std::get_if<SessionJob>(&job);
        // The other jobs measure the copies after silence, which no emulator can play.
        if (one == nullptr) continue;
        if (auto valid = validate(one->spec.setting); !valid) return tl::unexpected{valid.error()};
        one->spec.rows_per_s = 0;
        sessions.push_back(std::move(*one));
    }
    return sessions;
}

std::vector<ProgramFile> program_files(const virtual_time::Setting& setting)
{
    const auto& players = setting.players;
    return {{"algorithm.toml", peer::print_algorithm(players[0].algorithm)},
            {"left.toml", device::print_operator(players[0].person)},
            {"right.toml", device::print_operator(players[1].person)},
            {"scene.toml", scene::to_text(setting.scene)},
            {"profile.toml", emulator::to_text(setting.profile)},
            {"peer.words", fmt::format("--send {} --playout {}\n", text_of(players[0].send),
                                       base::name_of(players[0].playout))}};
}

} // namespace hapnet::lab::experiment
