// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/normal.hpp"

#include "proto/base/random.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace hapnet::base::normal_test {
namespace {

constexpr std::uint64_t points = 20'000;
constexpr long double sqrt_two = 1.41421356237309504880168872420969808L;

long double true_cdf(long double z) { return 0.5L * boost::math::erfc(-z / sqrt_two); }
long double true_quantile(long double p) { return -sqrt_two * boost::math::erfc_inv(2.0L * p); }

TEST(Normal, TheCdfErrsByAtMostOnePartIn1e14InBothTailsToo)
{
    const RandomStream stream = Seed{4}.stream("points");
    for (const auto& [low, high] :
         {std::pair{-37.0, -6.0}, {-6.0, -0.5}, {-0.7, 0.7}, {0.5, 8.5}}) {
        double worst = 0.0;
        for (std::uint64_t i = 0; i < points; ++i) {
            const double z = low + (high - low) * stream.uniform(i);
            const long double truth = true_cdf(z);
            worst = std::max(worst, static_cast<double>(std::abs(normal_cdf(z) / truth - 1.0L)));
        }
        EXPECT_LE(worst, 1e-14) << low << " to " << high;
    }
}

TEST(Normal, TheQuantileErrsByAtMostTwoPartsIn1e15InBothTailsToo)
{
    const RandomStream stream = Seed{5}.stream("points");
    const auto error = [](double p) {
        const long double truth = true_quantile(p);
        return static_cast<double>(std::abs(normal_quantile(p) - truth) /
                                   std::max(1.0L, std::abs(truth)));
    };
    double worst = 0.0;
    for (std::uint64_t i = 0; i < points; ++i) {
        const double u = stream.uniform(i);
        worst = std::max(worst, error(0.5 * u));
        worst = std::max(worst, error(std::ldexp(1.0 + u, -static_cast<int>(i % 1000) - 2)));
        worst = std::max(worst, error(1.0 - std::ldexp(1.0 + u, -static_cast<int>(i % 48) - 2)));
    }
    EXPECT_LE(worst, 2e-15);
}

TEST(Normal, TheQuantileUndoesTheCdfOutToEightStandardDeviations)
{
    const RandomStream stream = Seed{6}.stream("points");
    for (std::uint64_t i = 0; i < points; ++i) {
        const double z = -8.0 * stream.uniform(i);
        ASSERT_NEAR(normal_quantile(normal_cdf(z)), z, 1e-14) << z;
    }
}

TEST(Normal, BothAscend)
{
    double cdf = 0.0;
    double quantile = -9.0;
    for (int i = 1; i < 40'000; ++i) {
        const double next_cdf = normal_cdf(-10.0 + i * 0.0005);
        const double next_quantile = normal_quantile(i / 40'000.0);
        ASSERT_GE(next_cdf, cdf) << i;
        ASSERT_GT(next_quantile, quantile) << i;
        cdf = next_cdf;
        quantile = next_quantile;
    }
}

} // namespace
} // namespace hapnet::base::normal_test
