// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::base {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Math, GivesTheTextbookValues)
{
    EXPECT_EQ(sin(0.0), 0.0);
    EXPECT_EQ(cos(0.0), 1.0);
    EXPECT_EQ(exp(0.0), 1.0);
    EXPECT_EQ(sin(1.57079632679489661923), 1.0);
    EXPECT_EQ(cos(3.14159265358979323846), -1.0);
}

TEST(Math, SineAndCosineOutsideTheirStatedRangeAreNotANumber)
{
    for (const double x : {1.000001e6, -1.000001e6, 1e300, infinity, -infinity, nan}) {
        EXPECT_TRUE(std::isnan(sin(x))) << x;
        EXPECT_TRUE(std::isnan(cos(x))) << x;
    }
    EXPECT_FALSE(std::isnan(sin(1e6)));
    EXPECT_FALSE(std::isnan(cos(-1e6)));
}

TEST(Math, ExpBeyondItsRangeIsZeroOrInfinity)
{
    EXPECT_EQ(exp(700.1), infinity);
    EXPECT_EQ(exp(infinity), infinity);
    EXPECT_EQ(exp(-700.1), 0.0);
    EXPECT_EQ(exp(-infinity), 0.0);
    EXPECT_TRUE(std::isnan(exp(nan)));
    EXPECT_TRUE(std::isfinite(exp(700.0)));
    EXPECT_GT(exp(-700.0), 0.0);
}

TEST(Math, LogOfWhatHasNoneIsInfiniteOrNotANumber)
{
    EXPECT_EQ(log(1.0), 0.0);
    EXPECT_EQ(log(0.0), -infinity);
    EXPECT_EQ(log(infinity), infinity);
    EXPECT_EQ(log1p(-1.0), -infinity);
    EXPECT_EQ(log1p(infinity), infinity);
    for (const double x : {-1e-300, -1.0, -infinity, nan}) EXPECT_TRUE(std::isnan(log(x))) << x;
    EXPECT_TRUE(std::isnan(log1p(-1.5)));
    EXPECT_NEAR(log(5e-324), -744.4400719213812, 1e-12);
}

TEST(Math, HasTheSameBitsWithEveryCompilerAtEveryOptimisationLevel)
{
    // FNV-1a over the bits of all results. A change of one bit changes it. The release, debug, asan
    // and tidy presets compare GCC and Clang, optimised and not.
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&hash](double value) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
    };
    for (int i = -20'000; i <= 20'000; ++i) {
        add(sin(i * 0.000731));
        add(cos(i * 0.731));
        add(sin(i * 49.9));
        add(exp(i * 0.0349));
    }
    EXPECT_EQ(hash, 8921497925586332548U);
}

TEST(Math, LogarithmAndNormalDistributionHaveTheSameBitsWithEveryCompilerToo)
{
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&hash](double value) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
    };
    for (int i = 1; i <= 20'000; ++i) {
        add(log(i * 0.000731));
        add(log1p(i * 0.0000731 - 0.73));
        add(normal_cdf(i * 0.001731 - 30.0));
        add(normal_quantile(i * 0.000049999));
        add(normal_quantile(0x1p-60 * i));
    }
    EXPECT_EQ(hash, 15053827966772600584U);
}

TEST(Math, SinesOfTurnsAreSinesWithTheSameBitsWithEveryCompiler)
{
    std::uint64_t hash = 0xcbf29ce484222325;
    constexpr int count = 7; // some are computed in lanes, some alone
    std::array<double, count> turns{};
    for (int i = -20'000; i <= 20'000; ++i) {
        for (int j = 0; j < count; ++j)
            turns[static_cast<std::size_t>(j)] = i * 0.000731 + j * 49.9;
        const auto given = turns;
        sines_of_turns(turns);
        for (int j = 0; j < count; ++j) {
            const auto place = static_cast<std::size_t>(j);
            // Whole turns are subtracted exactly. The rest is exact to 5e-16, std::sin to 1e-16.
            const double part = given[place] - std::round(given[place]);
            ASSERT_NEAR(turns[place], std::sin(two_pi * part), 6e-16) << given[place];
            hash = (hash ^ std::bit_cast<std::uint64_t>(turns[place])) * 0x100000001b3;
        }
    }
    EXPECT_EQ(hash, 3536116556227167765U);
    std::array<double, 6> quarters{0.0, 0.25, -0.25, 0.75, 1e6 + 0.25, -7.0};
    sines_of_turns(quarters);
    const std::array<double, 6> expected{0.0, 1.0, -1.0, -1.0, 1.0, 0.0};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(quarters[i], expected[i], 5e-16) << i;
}

TEST(Math, TheNormalDistributionEndsWhereItsProbabilitiesDo)
{
    EXPECT_EQ(normal_cdf(0.0), 0.5);
    EXPECT_EQ(normal_cdf(-infinity), 0.0);
    EXPECT_EQ(normal_cdf(infinity), 1.0);
    EXPECT_TRUE(std::isnan(normal_cdf(nan)));
    EXPECT_EQ(normal_quantile(0.5), 0.0);
    EXPECT_EQ(normal_quantile(0.0), -infinity);
    EXPECT_EQ(normal_quantile(1.0), infinity);
    for (const double p : {-0.1, 1.1, nan}) EXPECT_TRUE(std::isnan(normal_quantile(p))) << p;
    EXPECT_GT(normal_quantile(1.0 - 0x1p-53), 8.2);
}

} // namespace
} // namespace hapnet::base
