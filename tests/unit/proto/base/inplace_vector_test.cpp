// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/inplace_vector.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::base {
namespace {

struct Entry {
    int number = 7;
    char letter = 'x';
};

TEST(InplaceVector, KeepsWhatIsPushedUntilItIsCleared)
{
    InplaceVector<Entry, 3> entries;
    EXPECT_TRUE(entries.empty());
    entries.push_back({1, 'a'});
    entries.push_back({2, 'b'});
    EXPECT_FALSE(entries.full());
    entries.push_back({3, 'c'});
    EXPECT_TRUE(entries.full());
    ASSERT_EQ(entries.size(), 3U);
    std::vector<int> numbers;
    for (const Entry& entry : entries.all()) numbers.push_back(entry.number);
    EXPECT_EQ(numbers, (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(entries[2].letter, 'c');
    entries.clear();
    EXPECT_TRUE(entries.all().empty());
    entries.push_back({});
    EXPECT_EQ(entries[0].number, 7);
}

TEST(InplaceVectorDeathTest, RefusesOneMoreThanItHoldsRoomFor)
{
    InplaceVector<int, 1> one;
    one.push_back(1);
    EXPECT_DEATH(one.push_back(2), "");
}

} // namespace
} // namespace hapnet::base
