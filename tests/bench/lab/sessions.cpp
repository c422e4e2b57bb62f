// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/lab/sessions.hpp"

#include "lab/metrics/spread.hpp"
#include "proto/base/ensure.hpp"
#include "scene/text/text.hpp"
#include "tests/bench/lab/stepped_hand.hpp"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace hapnet::bench {

namespace {

constexpr base::Duration paper_delay{std::chrono::milliseconds{160}};

/// The scene that a task is made for.
scene::Description scene_for(device::Task task)
{
    const auto no_file = [](const std::string& file) { return base::fail(file); };
    return scene::load_scene(std::string{device::scene_of(task)}, no_file).value();
}

lab::virtual_time::Trace trace_of(const Session& session)
{
    if (session.steps_a_read == 0) return lab::virtual_time::play(session.setting).value();
    lab::virtual_time::VirtualWorld world{session.setting};
    for (const std::size_t side : {0U, 1U}) {
        const lab::virtual_time::PlayerSetting& player = session.setting.players.at(side);
        world.side(side).rig = device::Rig{
            std::make_unique<SteppedHand>(device::Performer{.task = session.setting.task,
                                                            .options = session.setting.task_options,
                                                            .person = player.person},
                                          session.steps_a_read),
            {.tick = session.setting.tick}};
    }
    return lab::virtual_time::play_out(world).value();
}

} // namespace

Session session_of(device::Task task, std::string_view algorithm)
{
    Session session;
    session.setting.task = task;
    session.setting.scene = scene_for(task);
    session.setting.profile.path.up.delay = emulator::constant(paper_delay);
    session.setting.profile.path.down.delay = emulator::constant(paper_delay);
    for (lab::virtual_time::PlayerSetting& player : session.setting.players) {
        player.algorithm = peer::algorithm_named(algorithm).value();
    }
    return session;
}

Result played(const Session& session)
{
    const auto begin = std::chrono::steady_clock::now();
    lab::virtual_time::Trace trace = trace_of(session);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    base::ensure(!trace.sides[0].empty());
    return {std::move(trace), wall.count()};
}

Figures figures_of(const lab::virtual_time::Trace& trace)
{
    std::vector<double> apart_mm;
    apart_mm.reserve(trace.sides[0].size());
    for (std::size_t i = 0; i < trace.sides[0].size(); ++i) {
        const base::Displacement apart = trace.sides[0][i].body - trace.sides[1][i].body;
        apart_mm.push_back(1e3 * std::abs(apart.x()));
    }
    const auto spread = lab::metrics::spread_of(apart_mm);
    base::ensure(spread.has_value());
    return {spread->mean, spread->std, spread->max};
}

} // namespace hapnet::bench
