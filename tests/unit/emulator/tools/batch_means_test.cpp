// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/batch_means.hpp"

#include "proto/base/random.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::emulator::tools::batch_means_test {
namespace {

/// A series around 0.5 with uniform innovations; `memory` is the share of the previous value.
BatchMeans series(base::Seed seed, std::uint64_t count, double memory)
{
    BatchMeans means;
    const auto stream = seed.stream("series");
    double value = 0.5;
    for (std::uint64_t i = 0; i < count; ++i) {
        value = memory * value + (1.0 - memory) * stream.uniform(i);
        means.add(value);
    }
    return means;
}

double mean_of(base::Seed seed, std::uint64_t count, double memory)
{
    const auto stream = seed.stream("series");
    double value = 0.5;
    double sum = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
        value = memory * value + (1.0 - memory) * stream.uniform(i);
        sum += value;
    }
    return sum / static_cast<double>(count);
}

/// The share of 400 series whose interval contains the true mean, 0.5.
double coverage(std::uint64_t count, double memory)
{
    constexpr int series_count = 400;
    int covered = 0;
    for (int i = 0; i < series_count; ++i) {
        const base::Seed seed{static_cast<std::uint64_t>(i)};
        const double mean = mean_of(seed, count, memory);
        const double width = series(seed, count, memory).precision()->mean * mean;
        if (std::abs(mean - 0.5) <= width) ++covered;
    }
    return static_cast<double>(covered) / series_count;
}

TEST(BatchMeans, SayNothingOfTooFewValuesAndKnowConstantsExactly)
{
    EXPECT_FALSE(series(base::Seed{1}, BatchMeans::batches_min - 1, 0.0).precision());
    BatchMeans constant;
    for (int i = 0; i < 100'000; ++i) constant.add(0.16);
    EXPECT_EQ(constant.precision()->mean, 0.0);
    EXPECT_EQ(constant.precision()->sd, 0.0);
}

TEST(BatchMeans, KnowIndependentValuesAsWellAsTheoryDoes)
{
    // Uniform values: 1.96 sd / sqrt(n) of the mean, and 1.96 sqrt((9/5 - 1) / 4 / n) of the sd.
    // With 32 batches the errors are known to 13 %: 4 sd, and chance correlation adds to them.
    constexpr double n = 64'000.0;
    const auto precision = series(base::Seed{1}, 64'000, 0.0).precision().value();
    EXPECT_NEAR(precision.mean / (1.96 * 0.57735 / std::sqrt(n)), 1.1, 0.6);
    EXPECT_NEAR(precision.sd / (1.96 * std::sqrt(0.2 / n)), 1.1, 0.6);
}

// 95 % with a deviation of 1.1 %; a widening by chance correlation only adds.
TEST(BatchMeans, HaveTheTrueMeanWithinTheirIntervalAsOftenAsTheySay)
{
    EXPECT_GE(coverage(4000, 0.0), 0.91);
    EXPECT_GE(coverage(20'000, 0.99), 0.91); // 100 values are worth one
}

TEST(BatchMeans, AreNotSettledWhileTheValuesRise)
{
    BatchMeans rising;
    for (int i = 0; i < 100'000; ++i) rising.add(1e-3 + 1e-8 * i);
    EXPECT_GT(rising.precision()->mean, 0.05);
}

} // namespace
} // namespace hapnet::emulator::tools::batch_means_test
