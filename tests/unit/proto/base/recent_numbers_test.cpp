// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/recent_numbers.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <type_traits>

namespace hapnet::base {
namespace {

constexpr std::size_t far = 1024;
using Window = RecentNumbers<far>;

// It owns no memory: adding cannot allocate.
static_assert(std::is_trivially_copyable_v<Window>);

TEST(RecentNumbers, KnowsNumbersAsFarBackAsItLooksAlsoAfterAGap)
{
    Window window;
    EXPECT_EQ(window.add(1), Seen::no);
    EXPECT_EQ(window.add(far), Seen::no);
    EXPECT_EQ(window.add(1), Seen::yes);
    EXPECT_EQ(window.add(far + 1), Seen::no); // 1 shares its bit with it
    EXPECT_EQ(window.add(1), Seen::too_old_to_tell);
    EXPECT_EQ(window.add(3 * far), Seen::no);
    for (std::uint64_t number = 2 * far + 1; number < 3 * far; ++number) {
        ASSERT_EQ(window.add(number), Seen::no);
    }
    EXPECT_EQ(window.add(2 * far + 1), Seen::yes);
    EXPECT_EQ(window.add(2 * far), Seen::too_old_to_tell);
}

TEST(RecentNumbers, BeginsWithAnyNumberAndReachesTheLast)
{
    constexpr auto last = std::numeric_limits<std::uint64_t>::max();
    Window window;
    EXPECT_EQ(window.add(0), Seen::no);
    EXPECT_EQ(window.add(0), Seen::yes);
    EXPECT_EQ(window.add(last), Seen::no);
    EXPECT_EQ(window.add(last), Seen::yes);
    EXPECT_EQ(window.add(last - 1), Seen::no);
    EXPECT_EQ(window.add(0), Seen::too_old_to_tell);
    EXPECT_EQ(Window{}.add(last), Seen::no);
}

TEST(RecentNumbers, BeginAtTheFirstNumberThatComes)
{
    Window window;
    EXPECT_EQ(window.highest(), std::nullopt);
    EXPECT_EQ(window.add(5'000'000), Seen::no);
    EXPECT_EQ(window.highest(), 5'000'000U);
    EXPECT_EQ(window.add(5'000'000 - far + 1), Seen::no);
    EXPECT_EQ(window.find(5'000'000 - far + 1), Seen::yes);
    EXPECT_EQ(window.find(5'000'000 - far), Seen::too_old_to_tell);
    EXPECT_EQ(window.highest(), 5'000'000U);
}

TEST(RecentNumbers, FindWithoutRemembering)
{
    Window window;
    EXPECT_EQ(window.find(7), Seen::no);
    EXPECT_EQ(window.find(7), Seen::no);
    EXPECT_EQ(window.highest(), std::nullopt);
}

} // namespace
} // namespace hapnet::base
