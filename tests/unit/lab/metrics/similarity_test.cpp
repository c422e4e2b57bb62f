// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/similarity.hpp"
#include "tests/unit/lab/metrics/waves.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

/// Two slow waves: there is one best lag.
std::vector<double> pressing(double seconds, double later_s)
{
    auto force = sine(0.5, seconds, -pi * later_s);
    const auto faster = sine(1.3, seconds, -2.6 * pi * later_s);
    for (std::size_t i = 0; i < force.size(); ++i)
        force[i] = 1.0 + 0.4 * force[i] + 0.3 * faster[i];
    return force;
}

TEST(Similarity, OfAForceToItselfDelayedIsOneAndFindsTheDelay)
{
    const auto same = similarity_of(pressing(10.0, 0.0), pressing(10.0, 0.160), wave_tick_s);
    ASSERT_TRUE(same);
    EXPECT_NEAR(same->share, 1.0, 1e-9);
    EXPECT_NEAR(same->lag_s, 0.160, 1e-9);
}

TEST(Similarity, SinksWhereTheForceBuzzes)
{
    auto buzzing = pressing(10.0, 0.050);
    const auto buzz = sine(120.0, 10.0);
    for (std::size_t i = 0; i < buzzing.size(); ++i) buzzing[i] += 0.3 * buzz[i];
    const auto similarity = similarity_of(pressing(10.0, 0.0), buzzing, wave_tick_s);
    ASSERT_TRUE(similarity);
    EXPECT_LT(similarity->share, 0.6);
    EXPECT_NEAR(similarity->lag_s, 0.050, 0.003);
}

TEST(Similarity, HasNothingToSayOfShortSignalsOrNone)
{
    EXPECT_FALSE(similarity_of({}, {}, wave_tick_s));
    EXPECT_FALSE(similarity_of(pressing(0.9, 0.0), pressing(0.9, 0.0), wave_tick_s));
    const std::vector<double> nothing(5000, 0.0);
    EXPECT_FALSE(similarity_of(nothing, nothing, wave_tick_s));
}

TEST(Similarity, OfConstantForcesIsThatOfTheirMeans)
{
    const auto similarity =
        similarity_of(std::vector<double>(5000, 1.0), std::vector<double>(5000, 1.0), wave_tick_s);
    ASSERT_TRUE(similarity);
    EXPECT_NEAR(similarity->share, 1.0, 1e-9);
    EXPECT_EQ(similarity->lag_s, 0.0);
}

} // namespace
} // namespace hapnet::lab::metrics
