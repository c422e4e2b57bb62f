// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/replay_window.hpp"

#include <gtest/gtest.h>
#include <random>
#include <set>

namespace hapnet::secure {

namespace {

constexpr std::uint32_t size = 128;
using Window = ReplayWindow<size>;

/// What is_fresh() said before the number was noted.
bool take(Window& window, std::uint32_t number)
{
    const bool is_fresh = window.is_fresh(number);
    if (is_fresh) window.note(number);
    return is_fresh;
}

} // namespace

TEST(ReplayWindow, BeginsAtTheFirstNumberThatComes)
{
    Window window;
    EXPECT_TRUE(take(window, 5'000'000));
    EXPECT_FALSE(take(window, 5'000'000));
    EXPECT_TRUE(take(window, 5'000'000 - size + 1));
    EXPECT_FALSE(window.is_fresh(5'000'000 - size));
}

TEST(ReplayWindow, RefusesWhatIsTooOldToTell)
{
    Window window;
    for (std::uint32_t number = 1; number <= size + 1; ++number) EXPECT_TRUE(take(window, number));
    EXPECT_FALSE(window.is_fresh(1));
    EXPECT_FALSE(window.is_fresh(0));
    EXPECT_TRUE(take(window, 10 * size));
    EXPECT_FALSE(window.is_fresh(9 * size));
    EXPECT_TRUE(take(window, 9 * size + 1));
    EXPECT_FALSE(take(window, 9 * size + 1));
}

TEST(ReplayWindow, ReachesTheLastNumberThatThereIs)
{
    Window window;
    EXPECT_TRUE(take(window, 0xffff'fffe));
    EXPECT_TRUE(take(window, 0xffff'ffff));
    EXPECT_FALSE(take(window, 0xffff'ffff));
    EXPECT_FALSE(window.is_fresh(0));
    EXPECT_TRUE(take(window, 0xffff'ffff - size + 1));
}

TEST(ReplayWindow, AgreesWithASetThatForgetsNothing)
{
    std::mt19937 engine{7};
    const auto draw = [&engine](std::uint32_t below) {
        return static_cast<std::uint32_t>(engine() % below);
    };
    for (int run = 0; run < 200; ++run) {
        Window window;
        std::set<std::uint32_t> come;
        std::uint32_t at = draw(0xffff'ffff);
        for (int i = 0; i < 500; ++i) {
            const std::uint32_t kind = draw(10);
            if (kind == 0) at += draw(3 * size); // a leap
            at += kind < 5 ? 1 : 0;
            const std::uint32_t number = at - draw(kind < 8 ? 8 : 2 * size);
            const bool is_old =
                !come.empty() && number < *come.rbegin() && *come.rbegin() - number >= size;
            ASSERT_EQ(take(window, number), !is_old && !come.contains(number))
                << "run " << run << ", step " << i;
            if (!is_old) come.insert(number);
        }
    }
}

} // namespace hapnet::secure
