// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::base {
namespace {

// Every test here has fixed seeds: it passes always or never. Each bound states the probability
// that a truly random source exceeds it.

constexpr std::uint64_t draws = 1 << 16;

double correlation_of_draws(const RandomStream& a, const RandomStream& b)
{
    double sum = 0.0; // of products of variables with mean 0 and variance 1/12
    for (std::uint64_t i = 0; i < draws; ++i) {
        sum += (a.uniform(i) - 0.5) * (b.uniform(i) - 0.5);
    }
    return 12.0 * sum / static_cast<double>(draws);
}

TEST(RandomStream, UniformFillsItsBinsEvenly)
{
    // Chi-square with 255 degrees of freedom: 372 is exceeded with p = 2e-6.
    constexpr std::size_t bins = 256;
    for (const std::string_view name : {"up/loss", "down/loss", "up/jitter", "hand/1"}) {
        const RandomStream stream = Seed{42}.stream(name);
        std::array<double, bins> counts{};
        for (std::uint64_t i = 0; i < draws; ++i) {
            ++counts.at(static_cast<std::size_t>(stream.uniform(i) * bins));
        }
        constexpr double expected = static_cast<double>(draws) / bins;
        double chi_square = 0.0;
        for (const double count : counts) {
            chi_square += (count - expected) * (count - expected) / expected;
        }
        EXPECT_LT(chi_square, 372.0) << name;
    }
}

TEST(RandomStream, UniformStaysWithinItsKolmogorovDistance)
{
    // D * sqrt(n) > 2.5 has p = 7e-6 (Kolmogorov's limit, 2 exp(-2 * 2.5^2)).
    const RandomStream stream = Seed{7}.stream("x");
    std::vector<double> values;
    for (std::uint64_t i = 0; i < draws; ++i) values.push_back(stream.uniform(i));
    std::sort(values.begin(), values.end());
    double distance = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(draws);
        distance = std::max(distance, std::abs(values[i] - share));
    }
    EXPECT_LT(distance * std::sqrt(static_cast<double>(draws)), 2.5);
}

TEST(RandomStream, EveryBitIsOneHalfOfTheTime)
{
    // Five standard deviations of a fair coin; 64 bits: p = 4e-5.
    const RandomStream stream = Seed{7}.stream("x");
    std::array<double, 64> ones{};
    for (std::uint64_t i = 0; i < draws; ++i) {
        const auto bits = stream.bits(i);
        for (std::size_t bit = 0; bit < 64; ++bit) ones.at(bit) += (bits >> bit & 1U) != 0 ? 1 : 0;
    }
    const double five_sigma = 5.0 * std::sqrt(static_cast<double>(draws)) / 2.0;
    for (const double count : ones) {
        EXPECT_NEAR(count, static_cast<double>(draws) / 2.0, five_sigma);
    }
}

TEST(RandomStream, BelowHitsEveryNumberEquallyOften)
{
    // Chi-square with 9 degrees of freedom: 42 is exceeded with p = 3e-6.
    const RandomStream stream = Seed{7}.stream("x");
    std::array<double, 10> counts{};
    for (std::uint64_t i = 0; i < draws; ++i) ++counts.at(stream.below(10, i));
    constexpr double expected = static_cast<double>(draws) / 10.0;
    double chi_square = 0.0;
    for (const double count : counts) {
        chi_square += (count - expected) * (count - expected) / expected;
    }
    EXPECT_LT(chi_square, 42.0);
}

TEST(RandomStream, StreamsOfDifferentNamesSeedsAndDrawsAreUncorrelated)
{
    // The correlation has standard deviation 1/sqrt(n); five of them: p = 6e-7 a pair.
    const double five_sigma = 5.0 / std::sqrt(static_cast<double>(draws));
    const Seed seed{42};
    const RandomStream loss = seed.stream("up/loss");
    for (const std::string_view name : {"up/jitter", "down/loss", "up/los", "up/lost", ""}) {
        EXPECT_LT(std::abs(correlation_of_draws(loss, seed.stream(name))), five_sigma) << name;
    }
    for (const std::uint64_t other : {0U, 41U, 43U, 42U << 8}) {
        const double r = correlation_of_draws(loss, Seed{other}.stream("up/loss"));
        EXPECT_LT(std::abs(r), five_sigma) << other;
    }
}

TEST(RandomStream, NeighbouringDrawsOfOneStreamAreUncorrelated)
{
    const double five_sigma = 5.0 / std::sqrt(static_cast<double>(draws));
    const RandomStream stream = Seed{42}.stream("up/loss");
    for (const std::uint64_t lag : {1U, 2U, 100U}) {
        double sum = 0.0;
        for (std::uint64_t i = 0; i < draws; ++i) {
            sum += (stream.uniform(i) - 0.5) * (stream.uniform(i + lag) - 0.5);
        }
        EXPECT_LT(std::abs(12.0 * sum / static_cast<double>(draws)), five_sigma) << lag;
    }
}

TEST(RandomStream, AChangedNameChangesHalfOfAllBits)
{
    // 64 * 1000 fair coins: standard deviation 126 bits; five of them.
    int changed = 0;
    for (int i = 0; i < 1000; ++i) {
        const Seed seed{static_cast<std::uint64_t>(i)};
        const auto name = "stream" + std::to_string(i);
        changed += std::popcount(seed.stream(name).bits(0) ^ seed.stream(name + "'").bits(0));
    }
    EXPECT_NEAR(changed, 32000, 5 * 126);
}

} // namespace
} // namespace hapnet::base
