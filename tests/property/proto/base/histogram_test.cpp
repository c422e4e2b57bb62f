// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/histogram.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::base {
namespace {

TEST(Histogram, QuantilesAreWithinOneSixtyFourthOfTheSortedOnesAndWithinTheirRange)
{
    constexpr double shares[] = {0.001, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0};
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const RandomStream stream = Seed{seed}.stream("durations");
        const double decades = 1.0 + 11.0 * stream.uniform(0, 1); // 10 ns to 1000 s
        const auto size = 1 + stream.below(3000, 0, 2);
        DurationHistogram histogram;
        std::vector<Duration::rep> sorted;
        for (std::uint64_t i = 0; i < size; ++i) {
            sorted.push_back(
                static_cast<Duration::rep>(std::pow(10.0, decades * stream.uniform(i))));
            histogram.add(Duration{sorted.back()});
        }
        std::sort(sorted.begin(), sorted.end());
        ASSERT_EQ(histogram.count(), size);
        ASSERT_EQ(histogram.max(), Duration{sorted.back()});
        for (const double share : shares) {
            const auto rank =
                static_cast<std::size_t>(std::ceil(share * static_cast<double>(size)));
            const auto exact = sorted.at(rank - 1);
            const auto told = histogram.quantile(share).value().count();
            ASSERT_LE(std::abs(told - exact), exact / 64) << seed << " " << share;
            ASSERT_GE(told, sorted.front()) << seed << " " << share;
            ASSERT_LE(told, sorted.back()) << seed << " " << share;
            // The count above a quantile agrees with the quantile's rank.
            const auto above = histogram.count_above(Duration{told});
            ASSERT_LE(above, size - rank) << seed << " " << share;
        }
        ASSERT_EQ(histogram.min(), Duration{sorted.front()});
        ASSERT_EQ(histogram.quantile(1.0 / static_cast<double>(size)), Duration{sorted.front()});
        ASSERT_EQ(histogram.quantile(1.0), Duration{sorted.back()});
        const auto each = [&](double share) { return histogram.quantile(share).value(); };
        ASSERT_EQ(histogram.quantiles(),
                  (Quantiles{each(0.5), each(0.9), each(0.99), each(0.999), each(1.0)}))
            << seed;
    }
}

} // namespace
} // namespace hapnet::base
