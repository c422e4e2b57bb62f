// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/metrics.hpp"
#include "lab/metrics/scores.hpp"
#include "lab/virtual_time/one_world.hpp"
#include "lab/virtual_time/play.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::virtual_time {

namespace {

using namespace std::chrono_literals;

Setting pressing()
{
    Setting setting;
    setting.task = device::Task::t2;
    setting.seed = base::Seed{7};
    return setting;
}

} // namespace

TEST(OneWorld, HasOneBodyForAllHandsWhichFeelEachOtherAtOnce)
{
    const auto trace = play(in_one_world(pressing()));
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_EQ(trace->overlap, 1.0);
    ASSERT_EQ(trace->sides[0].size(), trace->sides[1].size());
    EXPECT_EQ(trace->sides[0].size(), 27000U);
    double sum_n = 0.0, apart_n = 0.0;
    for (std::size_t i = 0; i < trace->sides[0].size(); ++i) {
        const Sample &left = trace->sides[0][i], &right = trace->sides[1][i];
        ASSERT_EQ(left.body, right.body);
        if (!left.touching || !right.touching) continue;
        EXPECT_TRUE(left.remote_touching && right.remote_touching);
        sum_n += std::abs(left.on_hand.x());
        apart_n += std::abs(left.on_hand.x() + right.on_hand.x());
    }
    EXPECT_GT(sum_n, 0.0);
    EXPECT_LT(apart_n, 0.15 * sum_n); // the platform's friction and the cube's mass take the rest
}

TEST(OneWorld, IsTheSameForAllAlgorithmsNetworksAndClocks)
{
    Setting other = pressing();
    other.profile.path.up.delay = other.profile.path.down.delay = emulator::constant(200ms);
    for (PlayerSetting& player : other.players) player.algorithm = *peer::algorithm_named("wave");
    other.players[1].clock_ahead = 3s;
    other.players[1].phase = 300us;
    const auto a = play(in_one_world(pressing())), b = play(in_one_world(other));
    ASSERT_TRUE(a && b);
    EXPECT_EQ(metrics::metrics_of(*a), metrics::metrics_of(*b));
}

TEST(OneWorld, IsWhatBaseComesCloseToOnAPerfectNetwork)
{
    const auto own = play(pressing()), due = play(in_one_world(pressing()));
    ASSERT_TRUE(own && due);
    const auto scores =
        scores_of(metrics::metrics_of(*own),
                  make_reference(metrics::metrics_of(*own), metrics::metrics_of(*due)));
    // Each copy receives the other's state a tick late.
    EXPECT_LT(*scores.stiffness_error, 0.1);
    EXPECT_GT(*scores.stiffness_error, 0.0);
}

TEST(OneWorld, HasTheDevicesOfItsHands)
{
    Setting smooth = pressing();
    for (PlayerSetting& player : smooth.players) player.omni.friction_n = 0.0;
    const auto own = play(smooth), due = play(in_one_world(smooth));
    const auto usual = play(in_one_world(pressing()));
    ASSERT_TRUE(own && due && usual);
    EXPECT_NE(metrics::metrics_of(*due), metrics::metrics_of(*usual));
    const auto scores =
        scores_of(metrics::metrics_of(*own),
                  make_reference(metrics::metrics_of(*own), metrics::metrics_of(*due)));
    EXPECT_LT(*scores.stiffness_error, 0.1);
}

TEST(OneWorld, GivesWayToAStop)
{
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(play(in_one_world(pressing()), &stop));
}

} // namespace hapnet::lab::virtual_time
