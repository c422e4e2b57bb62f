// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The copy of base in C (examples/algorithm) in whole sessions: the same bits as base itself.
#include "emulator/core/profile/text.hpp"
#include "lab/virtual_time/play.hpp"
#include "peer/shared_object/load.hpp"
#include "scene/text/text.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::lab {
namespace {

using namespace std::chrono_literals;

struct Case {
    device::Task task;
    const char* conditions;
    std::size_t players = 2;
};

virtual_time::Trace played(const Case& one, const peer::Algorithm& first,
                           const peer::Algorithm& rest)
{
    virtual_time::Setting setting;
    setting.task = one.task;
    setting.length = 12s;
    setting.scene = scene::load_scene(std::string{device::scene_of(one.task)}, {}).value();
    setting.profile = emulator::parse_profile(one.conditions, "conditions", {}).value();
    setting.players.resize(one.players);
    for (auto& player : setting.players) player.algorithm = rest;
    setting.players.front().algorithm = first;
    return virtual_time::play(setting).value();
}

void expect_same_bits(const virtual_time::Trace& a, const virtual_time::Trace& b)
{
    ASSERT_EQ(a.sides.size(), b.sides.size());
    for (std::size_t side = 0; side < a.sides.size(); ++side) {
        ASSERT_GT(a.sides[side].size(), 5000U);
        ASSERT_EQ(a.sides[side].size(), b.sides[side].size());
        for (std::size_t i = 0; i < a.sides[side].size(); ++i) {
            const virtual_time::Sample &x = a.sides[side][i], &y = b.sides[side][i];
            ASSERT_TRUE(x.body == y.body && x.body_velocity == y.body_velocity && x.hip == y.hip &&
                        x.on_hand == y.on_hand && x.on_body == y.on_body &&
                        x.touching == y.touching && x.remote_touching == y.remote_touching)
                << "side " << side << ", tick " << i;
        }
    }
}

TEST(BaseInC, GivesTheSameBitsAsBase)
{
    const auto copy = peer::shared_object::load_from_disk(HAPNET_EXAMPLE_BASE).value();
    const peer::Algorithm base = peer::BaseAlgorithm{};
    using device::Task;
    const Case cases[] = {
        {Task::p1, "both.delay = \"160ms\""},
        {Task::t1, "both.delay = \"20ms\"\nboth.loss = \"30%\""},
        {Task::t3, "both.delay = \"40ms\"\n"
                   "both.jitter = { law = \"uniform\", half_width = \"15ms\", order = \"free\" }"},
        {Task::t4, "both.delay = \"10ms\"\nboth.burst_loss = \"40/100\""},
        {Task::t7, "both.delay = \"20ms\"\nboth.loss = \"10%\"", 3},
        // A silence so long that forces fade, and the copies settle after it.
        {Task::t3, "[[at]]\ntime = \"4s\"\nboth.loss = \"100%\"\n[[at]]\ntime = \"5s\"\n"
                   "both.loss = \"0%\""},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.conditions);
        const auto expected = played(one, base, base);
        expect_same_bits(played(one, copy, copy), expected);
        expect_same_bits(played(one, copy, base), expected); // one side alone
    }
}

TEST(BaseInC, IsNoticedWhereItDiffers)
{
    const peer::Algorithm base = peer::BaseAlgorithm{}, other = peer::DeadReckoning{};
    const Case one{device::Task::t1, "both.delay = \"20ms\""};
    EXPECT_FALSE(played(one, base, base).sides[0].back().body ==
                 played(one, other, other).sides[0].back().body);
}

} // namespace
} // namespace hapnet::lab
