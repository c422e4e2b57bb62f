// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The energy bound in docs/design/remote-proxy.md of remote-proxy, over random networks, hands,
// numbers of peers and liars.
#include "scene/text/text.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/energy_play.hpp"

#include <gtest/gtest.h>

namespace hapnet::test::remote_proxy_energy_test {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration length = 15s;

peer::Algorithm proxies(double account_j = 0.03)
{
    return peer::RemoteProxy{peer::RemoteProxyOptions{.account_j = account_j}};
}

class RemoteProxyEnergy : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RemoteProxyEnergy, OfAllHandsTogetherStaysAboveItsBound)
{
    const EnergyCase one = drawn_energy_case(GetParam(), proxies(), length);
    const EnergyPlayed played = play_for_energy(one);
    if (!played.has_begun) GTEST_SKIP() << "the players did not meet: " << one.words;
    EXPECT_TRUE(played.is_finite) << one.words;
    EXPECT_GT(played.work_j, 0.0) << one.words;
    EXPECT_GT(played.least_j, -remote_proxy_bound_j(one, played)) << one.words;
    RecordProperty("case", one.words);
    RecordProperty("least_mj", std::to_string(1e3 * played.least_j));
    RecordProperty("bound_mj", std::to_string(-1e3 * remote_proxy_bound_j(one, played)));
}

INSTANTIATE_TEST_SUITE_P(Seed, RemoteProxyEnergy, testing::Range(std::uint64_t{0}, seeds(16)));
INSTANTIATE_TEST_SUITE_P(All, RemoteProxyEnergy, testing::Range(seeds(16), energy_sessions(48)));

/// Random networks and hands as above, with a cube that turns. Each of two copies or more can store
/// as much more as the cube gains on a corner.
class TurningCubeEnergy : public testing::TestWithParam<std::uint64_t> {};

TEST_P(TurningCubeEnergy, OfAllHandsTogetherStaysAboveItsBound)
{
    EnergyCase one = drawn_energy_case(GetParam(), proxies(), length);
    one.setting.task = device::Task::t8;
    one.setting.scene = scene::load_scene("turning", {}).value();
    const EnergyPlayed played = play_for_energy(one);
    if (!played.has_begun) GTEST_SKIP() << "the players did not meet: " << one.words;
    EXPECT_TRUE(played.is_finite) << one.words;
    EXPECT_GT(played.work_j, 0.0) << one.words;
    constexpr double on_a_corner_j = 0.0144; // 100 g, raised by 20 mm (sqrt(3) - 1)
    const auto copies = static_cast<double>(one.setting.players.size());
    EXPECT_GT(played.least_j, -remote_proxy_bound_j(one, played) - copies * on_a_corner_j)
        << one.words;
    RecordProperty("case", one.words);
    RecordProperty("least_mj", std::to_string(1e3 * played.least_j));
    RecordProperty("bound_mj", std::to_string(-1e3 * remote_proxy_bound_j(one, played)));
}

INSTANTIATE_TEST_SUITE_P(Seed, TurningCubeEnergy, testing::Range(std::uint64_t{0}, seeds(12)));
INSTANTIATE_TEST_SUITE_P(All, TurningCubeEnergy, testing::Range(seeds(12), std::uint64_t{24}));

TEST(TurningCubeEnergy, IsTheSameToTheBitWhenMessagesComeTwiceAndLate)
{
    EnergyCase one = drawn_energy_case(2, proxies(), 8s);
    one.setting.task = device::Task::t8;
    one.setting.scene = scene::load_scene("turning", {}).value();
    EXPECT_EQ(play_for_energy(one).hash, play_for_energy(one, Delivery::twice_and_late).hash);
}

/// A liar whose victim takes the intention as certain and projects nothing.
EnergyCase believed_liar(double account_j)
{
    peer::RemoteProxyOptions options{.account_j = account_j};
    options.proxy.believed_above_m_per_s = 10.0;
    options.proxy.unsure_by_m = options.proxy.soft_by_m = 1.0;
    EnergyCase one;
    one.setting.task = device::Task::t2;
    one.setting.length = length;
    const emulator::Conditions late{.delay = emulator::constant(200ms)};
    one.setting.profile.path = {late, late};
    for (auto& player : one.setting.players) player.algorithm = peer::RemoteProxy{options};
    one.age_max = 203ms;
    one.liar = 1;
    one.words = "a liar that is believed";
    return one;
}

TEST(RemoteProxyEnergy, IsKeptByTheAccountAlsoWhereALiarIsBelieved)
{
    const EnergyCase one = believed_liar(0.03);
    const EnergyPlayed played = play_for_energy(one);
    EXPECT_GT(played.least_j, -remote_proxy_bound_j(one, played));
}

TEST(RemoteProxyEnergy, WithoutTheAccountIsDrawnFromTheCopiesFarBeyondTheBound)
{
    const EnergyCase one = believed_liar(10.0); // it is never spent
    EnergyPlayed played = play_for_energy(one);
    played.withdrawn_j = play_for_energy(believed_liar(0.03)).withdrawn_j;
    EXPECT_LT(played.least_j, -remote_proxy_bound_j(one, played));
}

TEST(RemoteProxyEnergy, IsTheSameToTheBitWhenMessagesComeTwiceAndLate)
{
    for (const std::uint64_t seed : {1U, 2U, 6U, 7U}) {
        const EnergyCase one = drawn_energy_case(seed, proxies(), 8s);
        EXPECT_EQ(play_for_energy(one).hash, play_for_energy(one, Delivery::twice_and_late).hash)
            << one.words;
    }
}

} // namespace
} // namespace hapnet::test::remote_proxy_energy_test
