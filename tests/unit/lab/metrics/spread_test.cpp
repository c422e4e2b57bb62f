// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/spread.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

TEST(Spread, IsThatOfThePopulation)
{
    const auto spread = spread_of(std::vector{1.0, 2.0, 3.0, 6.0});
    ASSERT_TRUE(spread);
    EXPECT_EQ(spread->mean, 3.0);
    EXPECT_EQ(spread->min, 1.0);
    EXPECT_EQ(spread->max, 6.0);
    EXPECT_EQ(spread->std, std::sqrt(3.5));
    EXPECT_FALSE(spread_of({}));
}

} // namespace
} // namespace hapnet::lab::metrics
