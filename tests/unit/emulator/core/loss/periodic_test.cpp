// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/periodic.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using test::losses;
using test::refusal;

} // namespace

TEST(PeriodicLoss, TakesTheNumbersOfItsPhase)
{
    EXPECT_EQ(losses(PeriodicLoss{4, 0}, 10), "1000100010");
    EXPECT_EQ(losses(PeriodicLoss{4, 3}, 10), "0001000100");
}

TEST(PeriodicLoss, WantsItsPhaseWithinItsPeriod)
{
    EXPECT_EQ(refusal(PeriodicLoss{10, 10}), "phase 10 is outside the period: write 0 to 9");
    EXPECT_NE(refusal(PeriodicLoss{0, 0}), "");
}

} // namespace hapnet::emulator
