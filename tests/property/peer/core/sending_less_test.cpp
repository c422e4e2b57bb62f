// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Peers that send fewer messages, with and without a playout buffer, keep the energy bound of
// remote-proxy, over random networks, hands, numbers of peers and liars.
#include "peer/core/send_policy.hpp"
#include "proto/base/random.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/energy_play.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <variant>

namespace hapnet::test::sending_less_test {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration length = 15s;
constexpr std::uint64_t first_seed = 5000; // no other test plays these cases

peer::SendPolicy drawn_policy(std::uint64_t seed)
{
    const base::Seed draws{seed};
    const auto draw = [&draws](std::string_view what, std::uint64_t below) {
        return draws.stream(what).bits(0) % below;
    };
    const auto text = draw("kind", 2) == 0 ? fmt::format("every:{}", 1 + draw("every", 50))
                                           : fmt::format("deadband:{}%,{}ms", draw("share", 31),
                                                         1 + draw("silence", 100));
    return peer::parse_send_policy(text).value();
}

base::Duration silence_of(const peer::SendPolicy& policy)
{
    return policy.deadband ? policy.silence_max : policy.every * base::Duration{1ms};
}

/// The longest gap that a network makes, in messages. A longer gap occurs once in e^9 messages.
double gap_of(const emulator::Conditions& network)
{
    if (network.loss.empty()) return 0.0;
    if (const auto* burst = std::get_if<emulator::Burst>(&network.loss.front()))
        return static_cast<double>(burst->lost);
    return -9.0 / std::log(std::get<emulator::RandomLoss>(network.loss.front()).share.fraction());
}

struct Case {
    EnergyCase energy;
    bool is_heard = true; // no gap is so long that a peer counts as silent
};

Case drawn_case(std::uint64_t seed)
{
    Case one{drawn_energy_case(first_seed + seed, peer::RemoteProxy{}, length)};
    const peer::SendPolicy policy = drawn_policy(seed);
    const bool plays_out = base::Seed{seed}.stream("playout").bits(0) % 2 == 1;
    for (auto& player : one.energy.setting.players) {
        player.send = policy;
        if (plays_out) player.playout = peer::Playout::adaptive;
    }
    // A buffer delays no state beyond the slowest one, except for a tick.
    if (plays_out) one.energy.age_max += 1ms;
    const double gap = gap_of(one.energy.setting.profile.path.up);
    const double longer_s = base::to_seconds(silence_of(policy)) - 1e-3; // than a tick
    one.energy.age_max += base::from_seconds((gap + 1.0) * longer_s);
    one.energy.words += ", " + text_of(policy) + (plays_out ? ", adaptive playout" : "");
    one.is_heard = (gap + 1.0) * base::to_seconds(silence_of(policy)) < 0.2;
    return one;
}

class SendingLess : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SendingLess, KeepsTheEnergyBound)
{
    const auto [one, is_heard] = drawn_case(GetParam());
    const EnergyPlayed played = play_for_energy(one);
    if (!played.has_begun) GTEST_SKIP() << "the players did not meet: " << one.words;
    EXPECT_TRUE(played.is_finite) << one.words;
    if (is_heard) {
        EXPECT_GT(played.work_j, 0.0) << one.words;
    }
    EXPECT_GT(played.least_j, -remote_proxy_bound_j(one, played)) << one.words;
    RecordProperty("case", one.words);
    RecordProperty("least_mj", std::to_string(1e3 * played.least_j));
    RecordProperty("bound_mj", std::to_string(-1e3 * remote_proxy_bound_j(one, played)));
}

INSTANTIATE_TEST_SUITE_P(Seed, SendingLess,
                         testing::Range(std::uint64_t{0}, energy_sessions(seeds(8))));

} // namespace
} // namespace hapnet::test::sending_less_test
