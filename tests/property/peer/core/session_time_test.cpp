// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The statements in docs/design/algorithms.md on lag and rollback: how far a tick of the session is
// the same in all copies, whenever each copy plays it.
#include "lab/virtual_time/world.hpp"
#include "scene/text/text.hpp"
#include "tests/sim/peer/core/score.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/draws.hpp"
#include "tests/support/session/energy_play.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::test::session_time_test {
namespace {

using namespace std::chrono_literals;
using lab::virtual_time::Setting;
using lab::virtual_time::VirtualWorld;

constexpr base::Duration length = 10s;

/// Two to five peers with individual delays between them, up to `delay_max`, and with jitter that
/// reorders messages.
Setting drawn(std::uint64_t seed, const char* algorithm, base::Duration delay_max,
              base::Duration jitter_max)
{
    using device::Task;
    Draws draw{base::Seed{seed}, "session-time"};
    const std::size_t players = 2 + seed % 4;
    const std::array tasks{Task::t1, Task::t2, Task::t3, players == 2 ? Task::p1 : Task::t7};
    Setting setting{.task = tasks.at(seed / 4 % tasks.size())};
    if (players > 2) setting.scene = scene::load_scene("carry", {}).value();
    setting.seed = base::Seed{seed};
    setting.length = length;
    setting.players.resize(players);
    for (auto& player : setting.players) {
        player.algorithm = peer::algorithm_named(algorithm).value();
        player.phase = draw.up_to(999us);
        player.clock_ahead = draw.up_to(3s);
    }
    const base::Duration delay = draw.up_to(delay_max);
    emulator::Conditions both{.delay = emulator::constant(delay)};
    const base::Duration jitter = std::min(delay, jitter_max);
    if (jitter > 0ms) both.jitter = emulator::uniform(jitter);
    both.order = emulator::Order::free;
    setting.profile.path = {both, both};
    if (players > 2) {
        emulator::PathPatch slow{.path = "1-3", .up = {}, .down = {}};
        slow.up.delay = slow.down.delay = emulator::constant(draw.up_to(delay_max));
        setting.profile.paths = {slow};
    }
    return setting;
}

/// The places of the body by the ticks of the session, as one copy had them.
using Course = std::map<std::uint64_t, base::Position>;

struct Played {
    std::vector<Course> courses{};
    double way_m = 0.0; // path length of the body
};

/// `note` gets the state of a side after each tick, and adds it to the side's course.
template <typename Note>
Played played(const Setting& setting, const Note& note)
{
    VirtualWorld world{setting};
    Played found;
    found.courses.resize(world.sides());
    sim::run_until_started(world);
    const base::TimePoint end = world.now() + world.side(0).peer().hands_on();
    base::Position before;
    while (world.now() < end) {
        world.step();
        for (std::size_t side = 0; side < world.sides(); ++side)
            note(world.side(side).peer(), found.courses[side]);
        found.way_m += base::norm(world.side(0).peer().position() - before);
        before = world.side(0).peer().position();
    }
    return found;
}

/// The largest distance of two copies at the same tick of the session, and the number of ticks that
/// two copies had.
struct Apart {
    double most_m = 0.0;
    std::size_t compared = 0;
};
Apart apart(const std::vector<Course>& courses)
{
    Apart found;
    for (std::size_t a = 0; a < courses.size(); ++a) {
        for (std::size_t b = a + 1; b < courses.size(); ++b) {
            for (const auto& [tick, place] : courses[a]) {
                const auto there = courses[b].find(tick);
                if (there == courses[b].end()) continue;
                ++found.compared;
                found.most_m = std::max(found.most_m, base::norm(there->second - place));
            }
        }
    }
    return found;
}

std::string words(const Setting& setting)
{
    return fmt::format("{} of {}, seed {}", name_of(setting.task), setting.players.size(),
                       setting.seed.value());
}

/// The least path of the body in a session. A body pressed from both sides hardly moves.
double least_way_m(device::Task task) { return task == device::Task::t2 ? 0.005 : 0.3; }

class SessionTime : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SessionTime, OfThePastIsTheSameToTheBitInAllCopiesThatRollBackWhereNoMessageIsLost)
{
    const Setting setting = drawn(GetParam(), "rollback", 250ms, 25ms);
    const Played all = played(setting, [](const peer::Peer& peer, Course& course) {
        const auto& algorithm = std::get<peer::Rollback>(peer.algorithm());
        course[algorithm.past().ticks()] = algorithm.past().position(0);
    });
    const Apart found = apart(all.courses);
    EXPECT_GT(all.way_m, least_way_m(setting.task)) << words(setting);
    EXPECT_GT(found.compared, 50U) << words(setting); // jitter skips many ticks at once
    EXPECT_EQ(found.most_m, 0.0) << words(setting);
}

TEST_P(SessionTime, OfCopiesThatLagIsTheSameToTheBitInAllWhereEveryMessageIsAsOld)
{
    const Setting setting = drawn(GetParam(), "lag", 200ms, 0ms);
    const Played all = played(setting, [](const peer::Peer& peer, Course& course) {
        course[peer.world().ticks()] = peer.position();
    });
    const Apart found = apart(all.courses);
    EXPECT_GT(all.way_m, least_way_m(setting.task)) << words(setting);
    EXPECT_GT(found.compared, 5000U) << words(setting);
    EXPECT_EQ(found.most_m, 0.0) << words(setting);
}

INSTANTIATE_TEST_SUITE_P(Seed, SessionTime, testing::Range(std::uint64_t{0}, seeds(3)));
INSTANTIATE_TEST_SUITE_P(All, SessionTime, testing::Range(seeds(3), std::uint64_t{8}));

TEST(SessionTime, OfTwoCopiesThatLagIsTheSameAtOnceOverASteadyDelay)
{
    for (const auto task : {device::Task::t1, device::Task::t3}) {
        emulator::Conditions both{.delay = emulator::constant(100ms)};
        Setting setting = sim::under(task, both);
        setting.length = length;
        for (auto& player : setting.players)
            player.algorithm = peer::algorithm_named("lag").value();
        VirtualWorld world{setting};
        sim::run_until_started(world);
        world.run_for(1s); // until the lag has settled
        const base::TimePoint end = world.now() + world.side(0).peer().hands_on() - 2s;
        double most_m = 0.0;
        while (world.now() < end) {
            world.step();
            most_m = std::max(most_m, sim::discrepancy_x(world));
        }
        EXPECT_LE(most_m, 1e-3) << name_of(task); // a tick of the fastest motion
    }
}

class RepeatedMessages : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RepeatedMessages, LeaveEveryBitOfTheSessionAsItIs)
{
    for (const char* name : {"lag", "rollback"}) {
        const auto length = test::is_sanitized ? 3s : 8s; // this takes a minute under sanitizers
        const EnergyCase one =
            drawn_energy_case(GetParam(), peer::algorithm_named(name).value(), length);
        const EnergyPlayed once = play_for_energy(one);
        EXPECT_TRUE(once.is_finite) << name << ", " << one.words;
        EXPECT_EQ(once.hash, play_for_energy(one, Delivery::twice_and_late).hash)
            << name << ", " << one.words;
    }
}

// For three and for four peers.
INSTANTIATE_TEST_SUITE_P(Seed, RepeatedMessages, testing::Values(1U));
INSTANTIATE_TEST_SUITE_P(All, RepeatedMessages, testing::Values(6U));

} // namespace
} // namespace hapnet::test::session_time_test
