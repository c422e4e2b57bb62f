// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/remote.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

wire::State state_number(std::uint32_t sequence)
{
    wire::State state;
    state.sequence = sequence;
    return state;
}

TEST(Remote, TakesNewerStatesOnly)
{
    Remote remote{{}};
    EXPECT_FALSE(remote.state());
    EXPECT_TRUE(remote.update(state_number(5), start));
    EXPECT_FALSE(remote.update(state_number(5), start + 1ms)); // a duplicate
    EXPECT_FALSE(remote.update(state_number(4), start + 2ms)); // late
    EXPECT_TRUE(remote.update(state_number(9), start + 3ms));
    EXPECT_EQ(remote.state()->sequence, 9U);
    EXPECT_EQ(remote.arrived(), start + 3ms);
}

TEST(Remote, KeepsTheNewestBodyThroughStatesWithoutOne)
{
    Remote remote{{}};
    wire::State with_body = state_number(1);
    with_body.bodies.add(wire::BodyState{}).position = {{0.01, 0.0, 0.0}};
    remote.update(with_body, start);
    remote.update(state_number(2), start + 1ms);
    ASSERT_TRUE(remote.body());
    EXPECT_EQ(remote.body()->position.x(), 0.01);
    remote.forget_state();
    EXPECT_FALSE(remote.body());
    EXPECT_FALSE(remote.arrived());
    EXPECT_TRUE(remote.update(state_number(1), start + 2ms)); // numbers start again
}

wire::BodyState pushed(std::uint16_t id, std::uint32_t given_uns)
{
    return {.body = id,
            .position = {},
            .velocity = {},
            .caused_displacement_um = {},
            .caused_impulse_uns = {given_uns, 0, 0},
            .turning = {}};
}

TEST(Remote, KeepsEachBodyAndKnowsTheOneThatWasPushedLast)
{
    Remote remote{{}};
    wire::State state = state_number(1);
    state.touching = true;
    state.bodies.add(pushed(2, 500));
    state.bodies.add(pushed(5, 0xffff'fff0)); // the sum exceeds 2^32
    remote.update(state, start);
    EXPECT_EQ(remote.bodies_known(), 2U);
    state.sequence = 2;
    state.bodies.clear();
    state.bodies.add(pushed(2, 510));
    state.bodies.add(pushed(5, 0x10));
    remote.update(state, start + 1ms);
    ASSERT_TRUE(remote.touched());
    EXPECT_EQ(remote.touched()->body, 5U);
    EXPECT_EQ(remote.body(2)->caused_impulse_uns[0], 510U);
    EXPECT_EQ(remote.body(3), nullptr);
    state.sequence = 3; // too weak a push to count in the sums
    remote.update(state, start + 2ms);
    EXPECT_EQ(remote.touched()->body, 5U);
    state.sequence = 4;
    state.touching = false;
    remote.update(state, start + 3ms);
    EXPECT_EQ(remote.touched(), nullptr);
    EXPECT_EQ(remote.bodies_known(), 2U);
}

TEST(Remote, IsFreshFor250MsAfterItsArrivalAndThenFadesIn50Ms)
{
    Remote remote{{}};
    EXPECT_EQ(remote.freshness_at(start), 0.0);
    remote.update(state_number(1), start);
    EXPECT_EQ(remote.freshness_at(start), 1.0);
    EXPECT_EQ(remote.freshness_at(start + 250ms), 1.0);
    EXPECT_LT(remote.freshness_at(start + 250ms + 1ns), 1.0);
    EXPECT_DOUBLE_EQ(remote.freshness_at(start + 275ms), 0.5);
    EXPECT_GT(remote.freshness_at(start + 300ms - 1ns), 0.0);
    EXPECT_EQ(remote.freshness_at(start + 300ms), 0.0);
    EXPECT_EQ(remote.freshness_at(start + 1h), 0.0);
}

TEST(Remote, IsNotRefreshedByWhatIsOutdated)
{
    Remote remote{{}};
    remote.update(state_number(5), start);
    remote.update(state_number(4), start + 200ms);
    EXPECT_EQ(remote.freshness_at(start + 300ms), 0.0);
}

TEST(Remote, CountsFromArrivalsThatNeverRunBackwards)
{
    Remote remote{{}};
    remote.update(state_number(1), start + 100ms);
    remote.update(state_number(2), start); // its stamp is earlier
    EXPECT_EQ(remote.arrived(), start + 100ms);
}

} // namespace
} // namespace hapnet::peer
