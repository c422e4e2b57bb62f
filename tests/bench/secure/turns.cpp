// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/secure/turns.hpp"

#include "proto/base/ensure.hpp"
#include "tests/bench/common/timing.hpp"
#include "tests/bench/secure/circle.hpp"

#include <array>
#include <deque>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <tuple>
#include <utility>

namespace hapnet::bench {

namespace {

using namespace std::chrono_literals;

using lab::virtual_time::Setting;

constexpr int turns_until_hands_are_on = 5000; // handshakes, the agreed start, the first second
constexpr std::array<std::size_t, 4> numbers{2, 3, 5, 8};
constexpr double added_by_a_peer_us = 1.5; // at most, and as much again by its keys

/// One of 2 to 8 peers who carry the paper's cube.
Setting carrying(std::size_t peers, bool is_keyed)
{
    Setting setting;
    setting.task = device::Task::t7;
    setting.scene.hands.count = 8;
    setting.length = 24h;
    setting.players.resize(peers);
    if (is_keyed) {
        for (auto& player : setting.players) player.circle = base::Seed{1};
    }
    return setting;
}

/// Eight cubes in a row that spin without friction, so that each message contains all of them. Two
/// hands turn the first.
Setting turning_eight()
{
    Setting setting = carrying(2, false);
    setting.task = device::Task::t8;
    scene::Description& scene = setting.scene;
    scene.planes[0].material.friction = 0.0;
    scene::BodyDescription cube = scene.bodies[0];
    cube.locked = {};
    cube.turning = scene::Turning::free;
    cube.drag_ns_per_m = 0.0;
    cube.material.friction = 0.0;
    scene.bodies.clear();
    for (int i = 0; i < 8; ++i) {
        cube.name = fmt::format("cube-{}", i + 1);
        cube.position = {{0.0, 0.0, -0.1 * i}};
        cube.angular_velocity = {0.0, i == 0 ? 0.0 : 3.0, 0.0};
        scene.bodies.push_back(cube);
    }
    return setting;
}

struct Case {
    std::size_t peers;
    bool is_keyed;
    Circle circle;
    std::vector<double> times_ns{};

    Case(std::size_t number, bool keyed, const Setting& setting)
        : peers{number}, is_keyed{keyed}, circle{setting}
    {
        base::ensure(lab::virtual_time::validate(setting).has_value());
        for (int i = 0; i < turns_until_hands_are_on; ++i) std::ignore = circle.turn();
        base::ensure(circle.measured().last().permitted); // they play
    }
    void play_block()
    {
        for (int i = 0; i < turns_a_block; ++i) times_ns.push_back(circle.turn());
    }
};

Row turn_row(std::string name, bool is_keyed, double value_us)
{
    return {.name = std::move(name),
            .subject = is_keyed ? "with keys" : "without",
            .baseline = "",
            .metric = "p50_us",
            .value = value_us,
            .baseline_value = std::nullopt,
            .target = std::nullopt};
}

} // namespace

std::vector<Row> measure_turns_of_many(int blocks)
{
    const double clock = clock_cost_ns();
    std::deque<Case> cases; // grows without moving its elements
    for (const std::size_t peers : numbers) {
        for (const bool is_keyed : {false, true})
            cases.emplace_back(peers, is_keyed, carrying(peers, is_keyed));
    }
    cases.emplace_back(2, false, turning_eight());
    for (int block = 0; block < blocks; ++block) {
        for (Case& one : cases) one.play_block();
    }

    std::vector<Row> rows;
    for (Case& one : cases) {
        const bool is_last = &one == &cases.back();
        rows.push_back(turn_row(is_last ? "a turn of one of 2 peers, eight bodies turn"
                                        : fmt::format("a turn of one of {} peers, T7", one.peers),
                                one.is_keyed, 1e-3 * (quantile(one.times_ns, 0.5) - clock)));
    }
    // The cost per added peer: from the first two cases and the last two of T7.
    const auto added_us = [&](std::size_t keyed) {
        const double further = static_cast<double>(numbers.back() - numbers.front());
        return (rows[2 * (numbers.size() - 1) + keyed].value - rows[keyed].value) / further;
    };
    for (const bool is_keyed : {false, true}) {
        rows.push_back(turn_row("what each further peer adds to a turn", is_keyed,
                                added_us(is_keyed ? 1 : 0)));
        rows.back().target = is_keyed ? 2.0 * added_by_a_peer_us : added_by_a_peer_us;
    }
    rows.push_back(turn_row("a state of eight bodies that turn", false,
                            static_cast<double>(cases.back().circle.newest().size())));
    rows.back().metric = "bytes";
    rows.back().target = 838.0;
    return rows;
}

} // namespace hapnet::bench
