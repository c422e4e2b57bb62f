// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/k_of_n.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using test::losses;
using test::refusal;
using test::stream;

} // namespace

TEST(BlockLoss, LosesExactlyItsNumberOfEveryBlock)
{
    for (const BlockLoss law : {BlockLoss{93, 100}, BlockLoss{1, 7}, BlockLoss{5, 5}}) {
        const auto text = losses(law, std::uint64_t{50} * law.of);
        for (auto begin = text.begin(); begin != text.end(); begin += law.of) {
            EXPECT_EQ(std::count(begin, begin + law.of, '1'), law.lost);
        }
    }
}

TEST(BlockLoss, FinishesTheBlockThatItHasBegunByTheNewNumber)
{
    LossProcess process{BlockLoss{10, 10}, stream()};
    EXPECT_EQ(losses(process, 0, 4), "1111");
    process.change(BlockLoss{4, 10});
    EXPECT_EQ(losses(process, 4, 6), "000000");
    const auto next = losses(process, 10, 10);
    EXPECT_EQ(std::count(next.begin(), next.end(), '1'), 4);
}

TEST(BlockLoss, WantsALossAndNoMoreThanItsBlock)
{
    EXPECT_EQ(refusal(BlockLoss{101, 100}),
              "cannot lose 101 of 100: write at least 1 and at most all, as in 40/100");
    EXPECT_NE(refusal(BlockLoss{0, 100}), "");
    EXPECT_NE(refusal(BlockLoss{0, 0}), "");
}

} // namespace hapnet::emulator
