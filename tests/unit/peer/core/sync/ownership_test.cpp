// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/ownership.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint begin{1h};
constexpr BodySet first = 1, second = 2, both = 3;
const std::vector<std::uint16_t> all{1, 2, 3};

TEST(Ownership, IsTheLowestIdsOfWhatNobodyHasTouched)
{
    EXPECT_EQ(Ownership{}.owner(first, all, begin), 1);
    const std::vector<std::uint16_t> some{4, 7};
    EXPECT_EQ(Ownership{}.owner(first, some, begin), 4);
}

TEST(Ownership, IsForASecondThatOfWhoTouchedLast)
{
    Ownership ownership;
    ownership.touch(first, 1, begin);
    ownership.touch(first, 3, begin + 600ms);
    EXPECT_EQ(ownership.owner(first, all, begin + 600ms), 3);
    EXPECT_EQ(ownership.owner(first, all, begin + 1600ms - 1ns), 3);
    EXPECT_EQ(ownership.owner(first, all, begin + 1600ms), 1);
    EXPECT_EQ(ownership.owner(second, all, begin + 600ms), 1); // no peer has touched them
}

TEST(Ownership, IsTheLowestIdsOfThoseWhoTouchedAtNearlyTheSameTime)
{
    Ownership ownership;
    ownership.touch(first, 2, begin);
    ownership.touch(first, 3, begin + 499ms);
    EXPECT_EQ(ownership.owner(first, all, begin + 499ms), 2);
    ownership.touch(first, 3, begin + 500ms);
    EXPECT_EQ(ownership.owner(first, all, begin + 500ms), 3);
}

TEST(Ownership, OfBodiesThatTouchEachOtherIsThatOfTheLastTouchOfAnyOfThem)
{
    Ownership ownership;
    ownership.touch(first, 2, begin);
    ownership.touch(second, 3, begin + 600ms);
    EXPECT_EQ(ownership.owner(both, all, begin + 700ms), 3);
    EXPECT_EQ(ownership.owner(first, all, begin + 700ms), 2);
}

TEST(Ownership, IsNotForOneWhoIsGone)
{
    Ownership ownership;
    ownership.touch(first, 3, begin);
    const std::vector<std::uint16_t> rest{1, 2};
    EXPECT_EQ(ownership.owner(first, rest, begin), 1);
}

} // namespace
} // namespace hapnet::peer
