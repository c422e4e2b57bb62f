// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/math.hpp"
#include "proto/base/random.hpp"

#include <bit>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

constexpr std::uint64_t points = 30'000;

/// The largest error of `ours` over random points of [low, high], in units in the last place
/// of the true value, which a long double (64-bit mantissa) stands for.
double worst_ulps(const std::function<double(double)>& ours,
                  const std::function<long double(long double)>& truth, double low, double high)
{
    const RandomStream stream = Seed{1}.stream("points");
    double worst = 0.0;
    for (std::uint64_t i = 0; i < points; ++i) {
        const double x = low + (high - low) * stream.uniform(i);
        const long double expected = truth(x);
        const double magnitude = std::abs(static_cast<double>(expected));
        const long double ulp = std::nextafter(magnitude, HUGE_VAL) - magnitude;
        const auto error = static_cast<double>(std::abs(ours(x) - expected) / ulp);
        worst = std::max(worst, error);
    }
    return worst;
}

long double true_sin(long double x) { return std::sin(x); }
long double true_cos(long double x) { return std::cos(x); }
long double true_exp(long double x) { return std::exp(x); }
long double true_log(long double x) { return std::log(x); }
long double true_log1p(long double x) { return std::log1p(x); }

TEST(Math, SineAndCosineErrByAtMostTwoUnitsInTheLastPlaceOverTheirWholeRange)
{
    for (const double range : {1e-3, 0.8, 4.0, 100.0, 1e4, 1e6}) {
        EXPECT_LE(worst_ulps(sin, true_sin, -range, range), 2.0) << range;
        EXPECT_LE(worst_ulps(cos, true_cos, -range, range), 2.0) << range;
    }
}

TEST(Math, SineIsAsGoodWhereItIsNearlyZero)
{
    for (const int k : {1, 2, 3, 1000, 100'000, 318'000}) {
        const double zero = k * 3.14159265358979323846;
        EXPECT_LE(worst_ulps(sin, true_sin, std::nextafter(zero, 0.0), std::nextafter(zero, 1e7)),
                  2.0)
            << k;
        EXPECT_LE(worst_ulps(sin, true_sin, zero - 1e-6, zero + 1e-6), 2.0) << k;
    }
}

TEST(Math, ExpErrsByAtMostTwoUnitsInTheLastPlace)
{
    for (const double range : {1e-6, 0.5, 10.0, 100.0, 700.0}) {
        EXPECT_LE(worst_ulps(exp, true_exp, -range, range), 2.0) << range;
    }
}

TEST(Math, LogErrsByAtMostTwoUnitsInTheLastPlace)
{
    for (const double scale : {1e-300, 1e-9, 0.5, 1.0, 2.0, 10.0, 1e9, 1e300}) {
        EXPECT_LE(worst_ulps(log, true_log, 0.5 * scale, 2.0 * scale), 2.0) << scale;
    }
    EXPECT_LE(worst_ulps(log, true_log, 1.0 - 1e-6, 1.0 + 1e-6), 2.0);
}

TEST(Math, Log1pErrsByAtMostFourUnitsInTheLastPlaceAlsoWhereOnePlusXLosesX)
{
    for (const double range : {1e-18, 1e-12, 1e-6, 1e-3, 0.4, 0.999}) {
        EXPECT_LE(worst_ulps(log1p, true_log1p, -range, range), 4.0) << range;
    }
    EXPECT_LE(worst_ulps(log1p, true_log1p, 1.0, 1e6), 4.0);
}

TEST(Math, LogUndoesExp)
{
    const RandomStream stream = Seed{4}.stream("points");
    for (std::uint64_t i = 0; i < points; ++i) {
        const double x = 1380.0 * (stream.uniform(i) - 0.5);
        EXPECT_NEAR(log(exp(x)), x, 1e-15 * (1.0 + std::abs(x))) << x;
    }
}

TEST(Math, SineSquaredPlusCosineSquaredIsOne)
{
    const RandomStream stream = Seed{2}.stream("points");
    for (std::uint64_t i = 0; i < points; ++i) {
        const double x = 2e6 * (stream.uniform(i) - 0.5);
        EXPECT_NEAR(sin(x) * sin(x) + cos(x) * cos(x), 1.0, 1e-15) << x;
    }
}

TEST(Math, SineIsOddAndCosineIsEven)
{
    const RandomStream stream = Seed{3}.stream("points");
    for (std::uint64_t i = 0; i < points; ++i) {
        const double x = 1e6 * stream.uniform(i);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sin(-x)), std::bit_cast<std::uint64_t>(-sin(x)));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(cos(-x)), std::bit_cast<std::uint64_t>(cos(x)));
    }
}

} // namespace
} // namespace hapnet::base
