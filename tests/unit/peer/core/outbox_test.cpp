// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/outbox.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

TEST(Outbox, GivesBackInOrder)
{
    Outbox<int, 3> box;
    EXPECT_FALSE(box.take());
    box.put(1);
    box.put(2);
    EXPECT_EQ(*box.take(), 1);
    box.put(3);
    box.put(4);
    EXPECT_EQ(*box.take(), 2);
    EXPECT_EQ(*box.take(), 3);
    EXPECT_EQ(*box.take(), 4);
    EXPECT_FALSE(box.take());
}

TEST(Outbox, DropsTheOldestWhenItIsFull)
{
    Outbox<int, 3> box;
    for (int i = 1; i <= 10; ++i) box.put(i);
    EXPECT_EQ(*box.take(), 8);
    EXPECT_EQ(*box.take(), 9);
    EXPECT_EQ(*box.take(), 10);
    EXPECT_FALSE(box.take());
}

} // namespace
} // namespace hapnet::peer
