// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/rolling_bytes.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

TimePoint at(int ms) { return TimePoint{} + std::chrono::milliseconds{ms}; }

TEST(RollingBytes, GivesWhatCameSinceATimeInItsOrder)
{
    RollingBytes rolling{1s, 100};
    for (int i = 0; i < 5; ++i) rolling.add(at(i * 100), std::to_string(i));
    EXPECT_EQ(rolling.since(at(0)), "01234");
    EXPECT_EQ(rolling.since(at(200)), "234");
    EXPECT_EQ(rolling.since(at(201)), "34");
    EXPECT_EQ(rolling.since(at(401)), "");
}

TEST(RollingBytes, ForgetsWhatIsOlderThanItsSpan)
{
    RollingBytes rolling{1s, 100};
    rolling.add(at(0), "old");
    rolling.add(at(1000), "just");
    EXPECT_EQ(rolling.since(at(0)), "oldjust");
    rolling.add(at(1001), "new");
    EXPECT_EQ(rolling.since(at(0)), "justnew");
    EXPECT_EQ(rolling.pieces(), 2U);
}

TEST(RollingBytes, NeverHoldsMoreThanItsBytesAndKeepsPiecesWholeAcrossItsEnd)
{
    RollingBytes rolling{1h, 10};
    std::string newest;
    for (int i = 0; i < 1000; ++i) {
        const std::string piece(static_cast<std::size_t>(1 + i % 4),
                                static_cast<char>('a' + i % 26));
        rolling.add(at(i), piece);
        newest += piece;
        const std::string held = rolling.since(at(0));
        ASSERT_LE(held.size(), 10U);
        ASSERT_GE(held.size(), 7U - (i < 4 ? 7U : 0U));
        ASSERT_TRUE(newest.ends_with(held)) << i;
    }
}

TEST(RollingBytes, LeavesOutWhatHasNoRoomAndTakesATimeThatGoesBackForTheNewest)
{
    RollingBytes rolling{1s, 4};
    rolling.add(at(500), "ab");
    rolling.add(at(600), "12345");
    EXPECT_EQ(rolling.since(at(0)), "ab");
    rolling.add(at(100), "cd");
    EXPECT_EQ(rolling.since(at(500)), "abcd");
}

} // namespace
} // namespace hapnet::base
