// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/paired.hpp"

#include <gtest/gtest.h>
#include <span>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

TEST(SignTest, IsTheBinomialTest)
{
    EXPECT_DOUBLE_EQ(sign_test(10, 0), 2.0 / 1024.0);
    EXPECT_DOUBLE_EQ(sign_test(1, 9), 22.0 / 1024.0);
    EXPECT_DOUBLE_EQ(sign_test(5, 5), 1.0);
    EXPECT_DOUBLE_EQ(sign_test(0, 0), 1.0);
}

TEST(IntervalOfMean, OfFewValuesIsTheirLeastAndTheirMost)
{
    const std::vector<double> five{1.0, 2.0, 3.0, 4.0, 15.0};
    for (std::size_t count = 1; count <= five.size(); ++count) {
        const auto few = interval_of_mean(std::span{five}.first(count));
        EXPECT_EQ(few.low, 1.0) << count;
        EXPECT_EQ(few.high, five[count - 1]) << count;
    }
    const std::vector<double> six{1.0, 2.0, 3.0, 4.0, 15.0, 16.0};
    ASSERT_EQ(six.size(), interval_seeds_min);
    EXPECT_GT(interval_of_mean(six).low, 1.0);
    EXPECT_LT(interval_of_mean(six).high, 16.0);
}

TEST(PairedTest, SeesADifferenceThatTheSpreadOfTheSeedsHides)
{
    std::vector<double> a, b;
    for (int seed = 0; seed < 20; ++seed) {
        b.push_back(static_cast<double>(seed));
        a.push_back(static_cast<double>(seed) + (seed % 2 == 0 ? 0.1 : 0.3));
    }
    const auto test = paired_test(a, b);
    EXPECT_NEAR(test.median, 0.2, 1e-12);
    EXPECT_GE(test.interval.low, 0.1 - 1e-12);
    EXPECT_LE(test.interval.high, 0.3 + 1e-12);
    EXPECT_EQ(test.above, 20U);
    EXPECT_LT(test.p, 1e-5);
}

TEST(PairedTest, SeesNoneBetweenTheSame)
{
    const std::vector<double> a{1.0, 2.0, 3.0};
    const auto test = paired_test(a, a);
    EXPECT_EQ(test.median, 0.0);
    EXPECT_EQ(test.p, 1.0);
    EXPECT_EQ(test.above + test.below, 0U);
}

} // namespace
} // namespace hapnet::lab::metrics
