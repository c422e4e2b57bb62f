// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/burst.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using test::losses;
using test::packet;
using test::refusal;
using test::stream;

} // namespace

TEST(Burst, BeginsAtItsPhaseInEveryPeriod)
{
    EXPECT_EQ(losses(Burst{2, 5, 0}, 12), "110001100011");
    EXPECT_EQ(losses(Burst{2, 5, 4}, 12), "100011000110");
}

TEST(Burst, WantsItsLengthAndPhaseWithinItsPeriod)
{
    EXPECT_NE(refusal(Burst{40, 39}), "");
    EXPECT_NE(refusal(Burst{40, 100, 100}), "");
    EXPECT_EQ(refusal(Burst{40, 100, 99}), "");
}

TEST(TimedBurst, OfATimeTakesWhatArrivesInIt)
{
    EXPECT_EQ(losses(TimedBurst{2ms, 5ms, 0ms}, 12), "110001100011");
    EXPECT_EQ(losses(TimedBurst{2ms, 5ms, 4ms}, 12), "100011000110");
    EXPECT_EQ(losses(TimedBurst{2ms + 1ns, 5ms, 0ms}, 12), "111001110011");
}

TEST(TimedBurst, OfACountTakesTheFirstOfEveryPeriodHoweverSlowTheyCome)
{
    EXPECT_EQ(losses(TimedBurst{2U, 5ms, 0ms}, 12), "110001100011");
    EXPECT_EQ(losses(TimedBurst{2U, 5ms, 3ms}, 12), "000110001100");
    LossProcess process{TimedBurst{2U, 5ms, 0ms}, stream()};
    std::string text;
    for (std::uint64_t n = 0; n < 6; ++n) {
        text += process.on_packet(packet(n, 6ms)) ? '1' : '0';
    }
    EXPECT_EQ(text, "111111");
}

TEST(TimedBurst, WantsItsLengthAndPhaseWithinItsPeriod)
{
    EXPECT_EQ(refusal(TimedBurst{2ms, 1ms}),
              "a burst must last longer than 0 and at most its period of 1ms");
    EXPECT_NE(refusal(TimedBurst{0ms, 1ms}), "");
    EXPECT_NE(refusal(TimedBurst{0U, 1ms}), "");
    EXPECT_NE(refusal(TimedBurst{1ms, 0ms}), "");
    EXPECT_NE(refusal(TimedBurst{1ms, 2ms, 2ms}), "");
}

} // namespace hapnet::emulator
