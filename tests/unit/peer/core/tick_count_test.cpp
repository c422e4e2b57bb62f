// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/tick_count.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

wire::State state_of(std::uint32_t sequence, base::Duration sent)
{
    wire::State state;
    state.sequence = sequence;
    state.sent = base::TimePoint{sent};
    return state;
}

TEST(TickCount, IsTheNumberWhereEveryTickHasAMessage)
{
    TickCount count;
    // A tick may be late, and messages may be lost or come in another order.
    EXPECT_EQ(count.of(state_of(5, 1005ms), 1ms).number, 5U);
    EXPECT_EQ(count.of(state_of(6, 1006ms + 700us), 1ms).number, 6U);
    EXPECT_EQ(count.of(state_of(90, 1090ms), 1ms).number, 90U);
    EXPECT_EQ(count.of(state_of(7, 1007ms), 1ms).number, 7U);
    EXPECT_EQ(count.of(state_of(8, 1008ms), 1ms).span, 1ms);
    // The loop stood still for 40 ms.
    EXPECT_EQ(count.of(state_of(91, 1131ms), 1ms).number, 91U);
}

TEST(TickCount, FollowsTheStampsOfWhoSendsInFewerTicks)
{
    TickCount count;
    for (std::uint32_t message = 0; message < 1000; ++message) {
        const base::Duration since_first = 10ms * message;
        const std::uint32_t tick = count.of(state_of(message + 1, 1s + since_first), 1ms).number;
        // Numbers count as ticks for 50 ticks and a tenth, until held-back messages are noticed.
        if (message > 6) {
            EXPECT_EQ(tick, 1 + 10 * message) << message;
        } else if (message < 6) {
            EXPECT_EQ(tick, 1 + message) << message;
        }
    }
    // Two of three messages are lost. One message still means 10 ms.
    EXPECT_EQ(count.of(state_of(1003, 1s + 10ms * 1002), 1ms).span, 10ms);
    count.forget();
    EXPECT_EQ(count.of(state_of(3, 2s), 1ms).number, 3U);
}

} // namespace
} // namespace hapnet::peer
