// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/maths/energy_share.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene {
namespace {

TEST(EnergyShare, IsWholeWhereNoMoreIsGainedThanMayBe)
{
    const EnergyOfShare loses{0.0, -3.0, 1.0};
    EXPECT_EQ(loses.share_within(0.0), 1.0);
    const EnergyOfShare gains{0.0, 1.0, 1.0};
    EXPECT_EQ(gains.share_within(2.0), 1.0);
}

TEST(EnergyShare, IsTheLargestWithWhichNoMoreIsGained)
{
    // -s + 2 s^2 is 0 at a half, 1/8 at (1 + sqrt 2) / 4.
    const EnergyOfShare energy{0.0, -1.0, 2.0};
    EXPECT_DOUBLE_EQ(energy.share_within(0.0), 0.5);
    EXPECT_DOUBLE_EQ(energy.share_within(0.125), 0.60355339059327376);
    // s + s^2 is 3/4 at a half.
    EXPECT_DOUBLE_EQ((EnergyOfShare{0.0, 1.0, 1.0}.share_within(0.75)), 0.5);
}

TEST(EnergyShare, IsThatWhichGainsLeastWhereNoneGainsSoLittle)
{
    const EnergyOfShare energy{1.0, -1.0, 2.0};
    EXPECT_DOUBLE_EQ(energy.share_within(0.0), 0.25);
    EXPECT_DOUBLE_EQ(energy.share_of_least(), 0.25);
    EXPECT_EQ((EnergyOfShare{0.0, 1.0, 1.0}.share_within(0.0)), 0.0);
    EXPECT_EQ((EnergyOfShare{0.0, 1.0, 1.0}.share_of_least()), 0.0);
    EXPECT_EQ((EnergyOfShare{0.0, -4.0, 1.0}.share_of_least()), 1.0);
}

TEST(EnergyShare, IsNoneOfWhatIsNotANumber)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ((EnergyOfShare{0.0, nan, 1.0}.share_within(0.0)), 0.0);
    EXPECT_EQ((EnergyOfShare{0.0, -1.0, nan}.share_within(0.0)), 0.0);
    EXPECT_EQ((EnergyOfShare{0.0, -1.0, nan}.share_of_least()), 0.0);
}

TEST(EnergyShare, ComesToOneThatHoldsWhateverIsGainedByIt)
{
    // The allowed gain is hardly more than zero, and shrinks with the square of the share.
    const EnergyOfShare energy{0.0, 0.9, 0.2};
    double share = 1.0;
    int rounds = 0;
    const auto most = [&] { return 1e-6 + share * share; };
    while (energy.at(share) > most() && rounds < share_rounds_max)
        share = next_share(share, energy.share_within(most()), rounds++);
    EXPECT_LE(energy.at(share), most());
    EXPECT_GT(share, 1e-7);
    EXPECT_LT(rounds, share_rounds_max);
}

} // namespace
} // namespace hapnet::scene
