// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The tasks with rotating bodies, and with several bodies, reach their goals.
#include "scene/maths/rotation.hpp"
#include "scene/text/text.hpp"
#include "tests/sim/peer/core/score.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::sim::tasks_test {
namespace {

using namespace std::chrono_literals;
using device::Task;

Setting playing(Task task, base::Duration delay, std::size_t players = 2)
{
    emulator::Conditions conditions;
    if (delay > 0ms) conditions.delay = emulator::constant(delay);
    Setting setting = under(task, conditions);
    setting.players.resize(players);
    setting.scene = scene::load_scene(std::string{device::scene_of(task)}, {}).value();
    return setting;
}

glm::dvec3 place(const World& world, std::size_t side, scene::BodyId body)
{
    return world.side(side).peer().world().position(body).value;
}

void play_to_hands_off(World& world)
{
    run_until_started(world);
    while (world.side(0).last().phase == peer::Phase::running) world.step();
    const auto end = world.now() + 2500ms;
    while (world.now() < end) world.step();
}

/// The angle of the cube of T8 about the vertical.
double turned_rad(const World& world, std::size_t side)
{
    const glm::dquat q = world.side(side).peer().body().orientation;
    return 2.0 * std::asin(q.w < 0.0 ? -q.y : q.y);
}

TEST(TaskT8, TurnsTheCubeToAndFroInBothCopies)
{
    for (const std::size_t players : {2U, 3U}) {
        for (const base::Duration delay : {0ms, 40ms}) {
            World world{playing(Task::t8, delay, players)};
            run_until_started(world);
            double least = 0.0, most = 0.0;
            while (world.side(0).last().phase == peer::Phase::running) {
                world.step();
                least = std::min(least, turned_rad(world, players - 1));
                most = std::max(most, turned_rad(world, players - 1));
            }
            EXPECT_GT(most - least, 0.25) << players << ' ' << delay.count();
        }
    }
}

TEST(TaskT9, BuildsATowerThatStandsInBothCopies)
{
    for (const std::size_t players : {2U, 3U}) { // the third watches
        for (const base::Duration delay : {0ms, 80ms}) {
            SCOPED_TRACE(std::to_string(players) +
                         " peers, ms: " + std::to_string(delay.count() / 1'000'000));
            World world{playing(Task::t9, delay, players)};
            play_to_hands_off(world);
            for (std::size_t side = 0; side < players; ++side) {
                for (const scene::BodyId cube : {0U, 1U, 2U}) {
                    const glm::dvec3 at = place(world, side, cube);
                    EXPECT_NEAR(at.y, -0.028 + 0.024 * cube, 0.5e-3) << cube;
                    EXPECT_LT(std::abs(at.x), 0.012) << cube;
                }
            }
        }
    }
}

TEST(TaskT10, HandsTheScrewdriverOverToTheRight)
{
    for (const std::size_t players : {2U, 4U}) { // two of the four watch
        for (const base::Duration delay : {0ms, 80ms}) {
            World world{playing(Task::t10, delay, players)};
            play_to_hands_off(world);
            for (std::size_t side = 0; side < players; ++side) {
                const glm::dvec3 at = place(world, side, 2);
                EXPECT_NEAR(at.y, -0.012, 0.5e-3) << players << ' ' << delay.count();
                EXPECT_NEAR(at.x, 0.04, 0.01) << players << ' ' << delay.count();
            }
        }
    }
}

} // namespace
} // namespace hapnet::sim::tasks_test
