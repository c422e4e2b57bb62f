// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// More than two players in one world.
#include "lab/metrics/metrics.hpp"
#include "lab/virtual_time/play.hpp"
#include "scene/text/text.hpp"
#include "tests/sim/peer/core/score.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/troubled_group.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::lab::virtual_time {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;
using device::Task;
using sim::under;

Setting carrying(std::size_t players, const emulator::Conditions& conditions)
{
    Setting setting = under(Task::t7, conditions);
    setting.scene = scene::load_scene("carry", [](const std::string& file) {
                        return base::fail(file);
                    }).value();
    setting.length = 8s;
    setting.players.resize(players);
    return setting;
}

double middle_delay_ms(const VirtualWorld& world, std::size_t from, std::size_t to)
{
    const auto& law = world.link(from, to).conditions().delay.law;
    return 1e3 * base::to_seconds(std::get<emulator::ConstantLaw>(law).value);
}

TEST(PlayerGroup, LeavesATraceOfEachWhoCarries)
{
    Setting setting = carrying(
        4, {.loss = {emulator::RandomLoss{30_percent}}, .delay = emulator::constant(20ms)});
    setting.players[2].phase = 400us;
    setting.players[3].clock_ahead = -7s;
    const auto trace = play(setting);
    ASSERT_TRUE(trace);
    ASSERT_EQ(trace->sides.size(), 4U);
    for (const auto& side : trace->sides) {
        ASSERT_EQ(side.size(), trace->sides.front().size());
        EXPECT_GT(side.size(), 4900U);
        EXPECT_GT(std::abs(side.back().body.x()), 0.01) << "it is carried";
    }
    EXPECT_GT(trace->overlap, 0.98);
}

TEST(PlayerGroup, MeasuresTheTwoCopiesThatAreFarthestApart)
{
    Setting setting = carrying(3, {});
    emulator::PathPatch slow{.path = "1-3", .up = {}, .down = {}};
    slow.up.delay = slow.down.delay = emulator::constant(120ms);
    setting.profile.paths = {slow};
    const auto trace = play(setting);
    ASSERT_TRUE(trace);
    const auto of_two = [&](std::size_t a, std::size_t b) {
        Trace pair = *trace;
        pair.sides = {trace->sides[a], trace->sides[b]};
        return metrics::metrics_of(pair).discrepancy_m->mean;
    };
    const double all = metrics::metrics_of(*trace).discrepancy_m->mean;
    EXPECT_EQ(all, std::max({of_two(0, 1), of_two(0, 2), of_two(1, 2)}));
    EXPECT_GT(of_two(0, 2), 0.0);
}

TEST(PlayerGroup, HasALinkOfItsOwnBetweenAnyTwo)
{
    Setting setting = carrying(3, {.delay = emulator::constant(10ms)});
    emulator::PathPatch own{.path = "2-3", .up = {}, .down = {}};
    own.down.delay = emulator::constant(70ms);
    setting.profile.paths = {own};
    VirtualWorld world{setting};
    EXPECT_EQ(middle_delay_ms(world, 0, 2), 10.0);
    EXPECT_EQ(middle_delay_ms(world, 1, 2), 10.0);
    EXPECT_EQ(middle_delay_ms(world, 2, 1), 70.0);
    sim::run_until_started(world);
    world.cut(0, 1, true);
    const auto received = [&](std::size_t from, std::size_t to) {
        return world.link(from, to).statistics().received;
    };
    const auto before = std::array{received(0, 1), received(1, 0), received(0, 2)};
    world.run_for(100ms);
    EXPECT_EQ(received(0, 1), before[0]);
    EXPECT_EQ(received(1, 0), before[1]);
    EXPECT_EQ(received(0, 2), before[2] + 100);
}

TEST(PlayerGroup, GivesEachLinkTheFatesOfAnEmulatorWithThisLink)
{
    const emulator::Conditions lossy{.loss = {emulator::RandomLoss{40_percent}}};
    VirtualWorld world{carrying(3, lossy)};
    world.run_for(3s);
    const Setting& setting = world.setting();
    emulator::EmulatedPath alone{
        setting.profile, {.seed = setting.seed, .start = VirtualWorld::start, .name = "2-3"}};
    const auto& statistics = world.link(1, 2).statistics();
    std::uint64_t delivered = 0;
    const std::array<std::byte, 100> bytes{};
    for (std::uint64_t i = 0; i < statistics.received; ++i) {
        const auto admission = alone.on_packet(emulator::Direction::up, bytes, VirtualWorld::start);
        if (!admission.drop) ++delivered;
    }
    // The datagrams of the last tick are still in the receiver's socket.
    EXPECT_NEAR(static_cast<double>(delivered), static_cast<double>(statistics.delivered), 2.0);
    EXPECT_NE(world.link(0, 1).statistics().delivered, statistics.delivered);
}

TEST(PlayerGroup, LetsOneJoinWhoComesLate)
{
    Setting setting = carrying(3, {.delay = emulator::constant(20ms)});
    setting.wait_for = 2;
    VirtualWorld world{setting};
    world.kill(2);
    world.run_for(4s);
    EXPECT_EQ(world.side(0).last().phase, peer::Phase::running);
    world.revive(2);
    world.run_for(1s);
    EXPECT_EQ(world.side(2).last().phase, peer::Phase::running);
    EXPECT_TRUE(world.side(2).last().permitted);
}

TEST(PlayerGroup, IsRefusedWhereItCannotPlay)
{
    const auto refusal = [](auto&& change) {
        Setting setting = carrying(3, {});
        change(setting);
        const auto valid = validate(setting);
        return valid ? std::string{} : valid.error().message;
    };
    EXPECT_EQ(refusal([](Setting&) {}), "");
    EXPECT_EQ(refusal([](Setting& s) { s.players.resize(1); }), "1 players: a session has 2 to 8");
    EXPECT_EQ(refusal([](Setting& s) { s.players.resize(9); }), "9 players: a session has 2 to 8");
    EXPECT_EQ(refusal([](Setting& s) { s.scene = scene::paper_scene(); }),
              "the scene 'paper' has 2 hands, and 3 play: choose another scene, such as carry, or "
              "raise count in its [hips]");
    EXPECT_EQ(
        refusal([](Setting& s) { s.players[1].algorithm = peer::algorithm_named("sep").value(); }),
        "sep is made for two, and 3 play: use base or remote-proxy, as in algorithms = \"base\"");
    EXPECT_EQ(
        refusal([](Setting& s) { s.profile.paths = {{.path = "1-4", .up = {}, .down = {}}}; }),
        "there is no link 1-4: use one of 1-2, 1-3, 2-3");
    EXPECT_EQ(refusal([](Setting& s) {
                  s.players.resize(2);
                  s.profile.paths = {{.path = "1-2", .up = {}, .down = {}}};
              }),
              "there is no link 1-2 between two: use both, up or down");
    EXPECT_EQ(refusal([](Setting& s) { s.wait_for = 4; }), "4 are waited for, and 3 play");
}

class TroubledGroups : public testing::TestWithParam<std::uint64_t> {};

TEST_P(TroubledGroups, OfTwoToFiveFeelNothingOfTheDeadAndAgreeInTheEnd)
{
    const std::uint64_t seed = GetParam();
    const auto played = test::play_troubled_group(seed, 2 + seed % 4, test::Seal::none);
    EXPECT_FALSE(played.complaint) << "seed " << seed << ": " << *played.complaint;
}

INSTANTIATE_TEST_SUITE_P(Seed, TroubledGroups, testing::Range(std::uint64_t{0}, test::seeds(50)));

TEST(PlayerGroup, IsNotHeldUpByAHandThatDiedBeforeItWasMet)
{
    // A restarted peer met one of the others, touched and died, before it met the second.
    const auto played = test::play_troubled_group(810041, 3, test::Seal::keys);
    EXPECT_FALSE(played.complaint) << *played.complaint;
}

TEST(PlayerGroup, WithKeysFeelsNothingOfTheDeadAndAgreesInTheEnd)
{
    for (const std::size_t peers : {3U, 5U}) {
        const auto played = test::play_troubled_group(peers, peers, test::Seal::keys);
        EXPECT_FALSE(played.complaint) << *played.complaint;
    }
}

} // namespace
} // namespace hapnet::lab::virtual_time
