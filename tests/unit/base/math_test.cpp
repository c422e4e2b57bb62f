// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/math.hpp"

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

TEST(Math, HasTheSameBitsWithEveryCompilerAtEveryOptimisationLevel)
{
    // FNV-1a over the bits of all results: changes when one bit of one of them does. The release,
    // debug, asan and tidy presets compare GCC and Clang, optimised and not.
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

} // namespace
} // namespace hapnet::base
