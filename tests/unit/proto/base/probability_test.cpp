// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/probability.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace hapnet::base {
namespace {

using namespace literals;

TEST(Probability, IsZeroUnlessSaid) { EXPECT_EQ(Probability{}.fraction(), 0.0); }

TEST(Probability, TakesEveryFractionFromZeroToOneAndNothingElse)
{
    constexpr double smallest = std::numeric_limits<double>::denorm_min();
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    EXPECT_TRUE(Probability::from_fraction(0.0));
    EXPECT_TRUE(Probability::from_fraction(1.0));
    EXPECT_FALSE(Probability::from_fraction(-smallest));
    EXPECT_FALSE(Probability::from_fraction(1.0 + epsilon));
    EXPECT_FALSE(Probability::from_fraction(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(Probability::from_fraction(std::numeric_limits<double>::infinity()));
}

TEST(Probability, PercentAreHundredths)
{
    EXPECT_EQ((93_percent).fraction(), 0.93);
    EXPECT_EQ((0.5_percent).fraction(), 0.005);
    EXPECT_EQ((50_percent).percent(), 50.0);
    EXPECT_LT(1_percent, 2_percent);
}

} // namespace
} // namespace hapnet::base
