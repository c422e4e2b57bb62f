// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/list.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using test::losses;
using test::refusal;
using test::stream;

} // namespace

TEST(ListedLoss, TakesItsNumbersAndNoOthers)
{
    EXPECT_EQ(losses(ListedLoss{{0, 3, 4, 9}}, 12), "100110000100");
    LossProcess late{ListedLoss{{0, 3, 4, 9}}, stream()};
    EXPECT_EQ(losses(late, 4, 6), "100001");
}

TEST(ListedLoss, WantsAscendingNumbers)
{
    EXPECT_EQ(refusal(ListedLoss{{1, 2, 2}}), "the numbers must ascend, but 2 comes before 2");
    EXPECT_EQ(refusal(ListedLoss{{}}), "");
}

} // namespace hapnet::emulator
