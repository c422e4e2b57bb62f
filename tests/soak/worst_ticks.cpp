// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/soak/worst_ticks.hpp"

#include "proto/net/clock.hpp"
#include "tests/support/scene/random_play.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::soak {

namespace {

constexpr std::size_t scenes_kept = 100;
constexpr std::size_t ticks_printed = 20;
constexpr int repeats = 5;
constexpr double limit_us = 100.0;

/// A rough cost, in ns, for choosing scenes, not for judging them.
double weight(const scene::TickCost& cost)
{
    return 100.0 * static_cast<double>(cost.pairs) + 300.0 * static_cast<double>(cost.contacts) +
           200.0 * static_cast<double>(cost.visits) + 30.0 * static_cast<double>(cost.spring_rows) +
           1000.0 * static_cast<double>(cost.events) + 300.0 * static_cast<double>(cost.looks);
}

std::size_t movable(const scene::Description& description)
{
    const auto moves = [](const auto& body) { return body.movable; };
    return static_cast<std::size_t>(
        std::count_if(description.bodies.begin(), description.bodies.end(), moves));
}

struct Scene {
    std::uint64_t seed = 0;
    double most = 0.0; // weight of a tick
};

/// The scenes with the most work in a tick, most first.
std::vector<Scene> heaviest(const WorstTicks& asked, std::size_t& played)
{
    std::vector<Scene> scenes;
    for (std::uint64_t seed = asked.first; seed < asked.first + asked.count; ++seed) {
        const auto play = test::random_play(seed);
        if (movable(play.description) > asked.bodies_max) continue;
        auto world = scene::World::freeze(play.description, play.options);
        if (!world) continue;
        ++played;
        Scene scene{.seed = seed};
        for (const auto& inputs : play.ticks) {
            test::feed(*world, inputs);
            world->tick();
            scene.most = std::max(scene.most, weight(world->tick_cost()));
        }
        scenes.push_back(scene);
    }
    std::stable_sort(scenes.begin(), scenes.end(),
                     [](const Scene& a, const Scene& b) { return a.most > b.most; });
    scenes.resize(std::min(scenes.size(), scenes_kept));
    return scenes;
}

struct Tick {
    double us = std::numeric_limits<double>::infinity();
    std::uint64_t seed = 0;
    std::size_t number = 0;
    scene::TickCost cost;
};

std::vector<Tick> timed(std::uint64_t seed)
{
    const auto play = test::random_play(seed);
    std::vector<Tick> ticks(play.ticks.size());
    for (int repeat = 0; repeat < repeats; ++repeat) {
        auto world = scene::World::freeze(play.description, play.options);
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            test::feed(*world, play.ticks[i]);
            const auto begin = net::monotonic_now();
            world->tick();
            const std::chrono::duration<double, std::micro> took = net::monotonic_now() - begin;
            ticks[i].us = std::min(ticks[i].us, took.count());
            ticks[i].seed = seed;
            ticks[i].number = i;
            ticks[i].cost = world->tick_cost();
        }
    }
    return ticks;
}

} // namespace

void print_worst_ticks(const WorstTicks& asked)
{
    std::size_t played = 0;
    std::vector<Tick> ticks;
    std::size_t scenes_over = 0;
    const std::vector<Scene> scenes = heaviest(asked, played);
    for (const Scene& scene : scenes) {
        const std::vector<Tick> its = timed(scene.seed);
        const auto is_over = [](const Tick& tick) { return tick.us > limit_us; };
        if (std::any_of(its.begin(), its.end(), is_over)) ++scenes_over;
        ticks.insert(ticks.end(), its.begin(), its.end());
    }
    std::stable_sort(ticks.begin(), ticks.end(),
                     [](const Tick& a, const Tick& b) { return a.us > b.us; });
    fmt::print("  of {} scenes with at most {} bodies the {} with the most work in a tick: {} with "
               "a tick over {} us\n",
               played, asked.bodies_max, scenes.size(), scenes_over, limit_us);
    for (std::size_t i = 0; i < std::min(ticks.size(), ticks_printed); ++i) {
        const Tick& tick = ticks[i];
        fmt::print("  seed {} tick {}: {:.0f} us; {} pairs, {} contacts, {} visits, {} spring "
                   "rows, {} events, {} looks\n",
                   tick.seed, tick.number, tick.us, tick.cost.pairs, tick.cost.contacts,
                   tick.cost.visits, tick.cost.spring_rows, tick.cost.events, tick.cost.looks);
    }
}

} // namespace hapnet::soak
