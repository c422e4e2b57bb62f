// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/fair_queue.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::secure {

namespace {

std::vector<int> all_of(FairQueue<int, 3>& queue)
{
    std::vector<int> taken;
    while (!queue.is_empty()) taken.push_back(queue.take());
    return taken;
}

} // namespace

TEST(FairQueue, GivesTheItemWithTheHighestNumberFirst)
{
    FairQueue<int, 3> queue;
    EXPECT_TRUE(queue.is_empty());
    EXPECT_TRUE(queue.add(1, 50));
    EXPECT_TRUE(queue.add(2, 90));
    EXPECT_TRUE(queue.add(3, 10));
    EXPECT_EQ(all_of(queue), (std::vector{2, 1, 3}));
    EXPECT_TRUE(queue.add(4, 1));
    EXPECT_EQ(all_of(queue), std::vector{4});
}

TEST(FairQueue, LosesTheItemWithTheLowestNumberWhenItIsFull)
{
    FairQueue<int, 3> queue;
    for (const int item : {1, 2, 3}) queue.add(item, 10U * static_cast<unsigned>(item));
    EXPECT_FALSE(queue.add(4, 25)); // takes the place of 1
    EXPECT_FALSE(queue.add(5, 5));  // dropped itself
    EXPECT_EQ(all_of(queue), (std::vector{3, 4, 2}));
}

TEST(FairQueue, FindsWhatWaitsAndNothingThatWasTaken)
{
    FairQueue<int, 3> queue;
    queue.add(1, 1);
    queue.add(2, 2);
    const auto is_two = [](int item) { return item == 2; };
    ASSERT_NE(queue.find(is_two), nullptr);
    EXPECT_EQ(*queue.find(is_two), 2);
    EXPECT_EQ(queue.take(), 2);
    EXPECT_EQ(queue.find(is_two), nullptr);
    queue.clear();
    EXPECT_TRUE(queue.is_empty());
}

} // namespace hapnet::secure
