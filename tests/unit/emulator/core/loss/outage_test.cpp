// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/outage.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using test::losses;
using test::refusal;

} // namespace

TEST(Outage, TakesWhatArrivesInItsWindowsAndNotAtTheirEnds)
{
    EXPECT_EQ(losses(Outage{{{1ms, 3ms}, {3ms, 4ms}, {6ms, 6ms + 1ns}}}, 8), "01110010");
}

TEST(Outage, WantsWindowsInOrder)
{
    EXPECT_EQ(refusal(Outage{{{1s, 2s}, {2s, 3s}}}), "");
    EXPECT_EQ(refusal(Outage{{{2s, 1s}}}), "the outage from 2s to 1s ends before it begins");
    EXPECT_EQ(refusal(Outage{{{1s, 3s}, {2s, 4s}}}),
              "the outage from 2s to 4s begins before 3s: outages must ascend and not overlap");
}

} // namespace hapnet::emulator
