// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/validated.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

std::string refusal(const LossLaw& law)
{
    const auto result = validated(law);
    return result ? "" : result.error().message;
}

} // namespace

TEST(ValidatedLoss, KeepsALawThatCanBeDone)
{
    const LossLaw law = Gilbert{93_percent, 13.3};
    EXPECT_EQ(validated(law).value(), law);
}

TEST(ValidatedLoss, WantsBurstsLongEnoughForTheirShare)
{
    EXPECT_EQ(refusal(Gilbert{93_percent, 5.0}),
              "at a share of 93% the mean burst is more than share / (1 - share) = 13.29 "
              "datagrams, or the good runs between bursts would be shorter than one");
    EXPECT_EQ(refusal(Gilbert{1_percent, 0.5}), "the mean burst is at least 1 datagram");
    EXPECT_EQ(refusal(Gilbert{1_percent, std::numeric_limits<double>::quiet_NaN()}),
              "the mean burst is at least 1 datagram");
    EXPECT_NE(refusal(Gilbert{100_percent, 1e9}), "");
}

TEST(ValidatedLoss, WantsCountsAndPhasesWithinTheirPeriod)
{
    EXPECT_EQ(refusal(BlockLoss{101, 100}),
              "loses 101 of 100: at least 1 is lost, and at most all, as in 40/100");
    EXPECT_NE(refusal(BlockLoss{0, 100}), "");
    EXPECT_NE(refusal(BlockLoss{0, 0}), "");
    EXPECT_EQ(refusal(PeriodicLoss{10, 10}), "the phase 10 is not within the period: write 0 to 9");
    EXPECT_NE(refusal(PeriodicLoss{0, 0}), "");
    EXPECT_NE(refusal(Burst{40, 39}), "");
    EXPECT_NE(refusal(Burst{40, 100, 100}), "");
    EXPECT_EQ(refusal(Burst{40, 100, 99}), "");
    EXPECT_EQ(refusal(TimedBurst{2ms, 1ms}),
              "a burst lasts longer than 0 and at most its period of 1ms");
    EXPECT_NE(refusal(TimedBurst{0ms, 1ms}), "");
    EXPECT_NE(refusal(TimedBurst{0U, 1ms}), "");
    EXPECT_NE(refusal(TimedBurst{1ms, 0ms}), "");
    EXPECT_NE(refusal(TimedBurst{1ms, 2ms, 2ms}), "");
}

TEST(ValidatedLoss, WantsChainsThatMove)
{
    EXPECT_NE(refusal(GilbertElliott{}), "");
    EXPECT_EQ(refusal(GilbertElliott{1_percent, 0_percent, 0_percent, 100_percent}), "");
    EXPECT_NE(refusal(TimedGilbertElliott{0ms, 1ms, 0_percent, 100_percent}), "");
}

TEST(ValidatedLoss, WantsFourStatesWhoseStepsAreProbabilities)
{
    EXPECT_EQ(refusal(FourState{5_percent, 20.0, 80_percent, 1_percent}), "");
    EXPECT_EQ(refusal(FourState{5_percent, 20.0, 100_percent, 0_percent}), "");
    EXPECT_EQ(refusal(FourState{5_percent, 20.0, 5_percent, 1_percent}),
              "isolated (1%) < share (5%) < density (5%) does not hold: bursts lose more than the "
              "whole does, and the gaps between them less");
    // p31 + p32 = 1 / 1 + 0.5 * 0.25 / 0.75, too much; 1 / (0.8 - 0.2 / 2) = 1.4286.
    EXPECT_EQ(refusal(FourState{5_percent, 1.25, 80_percent, 1_percent}),
              "bursts of density 80% with good runs of 2 are at least 1.429 long");
    EXPECT_EQ(refusal(FourState{5_percent, 1.429, 80_percent, 1_percent}), "");
    EXPECT_EQ(refusal(FourState{5_percent, 50.0, 20_percent, 1_percent, 3.0}),
              "good runs of mean length 3 do not leave a burst a density of 20%: write more than "
              "4 for good_run");
    // p13 = 0.8 / (E_B 0.15), p14 = 0: E_B is at least 5.3333.
    EXPECT_EQ(refusal(FourState{80_percent, 5.0, 95_percent, 0_percent}),
              "bursts of 5 are too short for a share of 80%, as each is followed by a gap: write "
              "at least 5.334, or a higher density");
    EXPECT_EQ(refusal(FourState{80_percent, 5.334, 95_percent, 0_percent}), "");
    EXPECT_NE(refusal(FourState{70_percent, 20.0, 80_percent, 60_percent}), "");
    EXPECT_NE(refusal(FourState{5_percent, 20.0, 80_percent, 1_percent, 0.5}), "");
}

TEST(ValidatedLoss, WantsListsAndWindowsInOrder)
{
    EXPECT_EQ(refusal(ListedLoss{{1, 2, 2}}), "the numbers ascend, but 2 comes before 2");
    EXPECT_EQ(refusal(ListedLoss{{}}), "");
    EXPECT_NE(refusal(PatternLoss{}), "");
    EXPECT_NE(refusal(TraceLoss{}), "");
    EXPECT_EQ(refusal(Outage{{{1s, 2s}, {2s, 3s}}}), "");
    EXPECT_EQ(refusal(Outage{{{2s, 1s}}}), "the outage from 2s to 1s ends before it begins");
    EXPECT_EQ(refusal(Outage{{{1s, 3s}, {2s, 4s}}}),
              "the outage from 2s to 4s begins before 3s: outages ascend and do not overlap");
}

} // namespace hapnet::emulator
