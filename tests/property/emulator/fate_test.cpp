// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What the draws of the impairments amount to. Virtual time, fixed seeds: a failure repeats.
#include "emulator/core/conditions.hpp"
#include "emulator/core/pipeline.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

std::vector<Verdict> fates(const Conditions& conditions, base::Seed seed, Direction direction,
                           std::uint64_t count)
{
    const auto pipeline = pipeline_of(conditions, seed, direction);
    std::vector<Verdict> verdicts;
    for (std::uint64_t number = 0; number < count; ++number) {
        verdicts.push_back(pipeline.on_packet(number));
    }
    return verdicts;
}

std::vector<bool> losses(const Conditions& conditions, base::Seed seed, Direction direction,
                         std::uint64_t count)
{
    std::vector<bool> lost;
    for (const Verdict& verdict : fates(conditions, seed, direction, count)) {
        lost.push_back(std::holds_alternative<Drop>(verdict));
    }
    return lost;
}

double share_of(const std::vector<bool>& lost)
{
    return static_cast<double>(std::count(lost.begin(), lost.end(), true)) /
           static_cast<double>(lost.size());
}

} // namespace

TEST(Fate, OfTheNthDatagramIsTheSameForTheSameSeed)
{
    const Conditions conditions{
        .loss = 30_percent, .burst_loss = Burst{4, 17}, .delay = 50ms, .jitter = 20ms};
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        EXPECT_EQ(fates(conditions, base::Seed{seed}, Direction::up, 1000),
                  fates(conditions, base::Seed{seed}, Direction::up, 1000));
    }
}

TEST(Fate, DiffersBetweenSeeds)
{
    const Conditions conditions{.loss = 30_percent};
    EXPECT_NE(losses(conditions, base::Seed{1}, Direction::up, 1000),
              losses(conditions, base::Seed{2}, Direction::up, 1000));
}

TEST(Fate, OfLossDoesNotDependOnDelayJitterOrOrder)
{
    const Conditions plain{.loss = 30_percent, .burst_loss = Burst{4, 17}};
    Conditions other = plain;
    other.delay = 160ms;
    other.jitter = 15ms;
    other.order = Order::free;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        EXPECT_EQ(losses(plain, base::Seed{seed}, Direction::up, 2000),
                  losses(other, base::Seed{seed}, Direction::up, 2000));
    }
}

TEST(Fate, OfJitterDoesNotDependOnLoss)
{
    const base::Seed seed{5};
    const auto without = fates({.delay = 50ms, .jitter = 20ms}, seed, Direction::up, 2000);
    const auto with =
        fates({.loss = 50_percent, .delay = 50ms, .jitter = 20ms}, seed, Direction::up, 2000);
    for (std::size_t i = 0; i < with.size(); ++i) {
        if (std::holds_alternative<Deliver>(with[i])) {
            EXPECT_EQ(with[i], without[i]);
        }
    }
}

TEST(Fate, WithMoreLossLosesWhatWasLostBeforeAndMore)
{
    const base::Seed seed{6};
    const auto few = losses({.loss = 10_percent}, seed, Direction::up, 5000);
    const auto many = losses({.loss = 60_percent}, seed, Direction::up, 5000);
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_TRUE(many[i] || !few[i]);
}

TEST(RandomLoss, LosesItsShareWithinFourStandardErrors)
{
    // Binomial: standard error sqrt(p (1 - p) / n); 4 of them: 1 in 16 000 by chance.
    constexpr std::uint64_t count = 200'000;
    for (const double p : {0.003, 0.05, 0.3, 0.93}) {
        const auto probability = base::Probability::from_fraction(p).value();
        for (const Direction direction : {Direction::up, Direction::down}) {
            const double share =
                share_of(losses({.loss = probability}, base::Seed{42}, direction, count));
            EXPECT_NEAR(share, p, 4 * std::sqrt(p * (1 - p) / count)) << to_text(direction);
        }
    }
}

TEST(RandomLoss, IsIndependentFromOneDatagramToTheNext)
{
    // The sample autocorrelation of n independent draws has standard error 1/sqrt(n).
    constexpr std::uint64_t count = 200'000;
    const auto lost = losses({.loss = 30_percent}, base::Seed{42}, Direction::up, count);
    for (const std::size_t lag : {1U, 2U, 3U, 100U}) {
        double sum = 0;
        for (std::size_t i = lag; i < lost.size(); ++i) {
            sum += (lost[i] ? 0.7 : -0.3) * (lost[i - lag] ? 0.7 : -0.3);
        }
        EXPECT_NEAR(sum / (count * 0.21), 0.0, 4 / std::sqrt(count)) << "lag " << lag;
    }
}

TEST(RandomLoss, OfTheTwoDirectionsIsUncorrelated)
{
    constexpr std::uint64_t count = 200'000;
    for (const std::uint64_t seed : {0U, 1U, 42U}) {
        const auto up = losses({.loss = 30_percent}, base::Seed{seed}, Direction::up, count);
        const auto down = losses({.loss = 30_percent}, base::Seed{seed}, Direction::down, count);
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            sum += (up[i] ? 0.7 : -0.3) * (down[i] ? 0.7 : -0.3);
        }
        EXPECT_NEAR(sum / (count * 0.21), 0.0, 4 / std::sqrt(count)) << "seed " << seed;
    }
}

TEST(BurstLoss, LosesExactlyItsNumberOfAnyPeriodAndInARow)
{
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        for (const Burst burst : {Burst{40, 100}, Burst{1, 7}, Burst{6, 7}, Burst{3, 3}}) {
            const auto lost = losses({.burst_loss = burst}, base::Seed{seed}, Direction::up, 1000);
            for (std::size_t first = 0; first + burst.of <= lost.size(); ++first) {
                const auto begin = lost.begin() + static_cast<std::ptrdiff_t>(first);
                ASSERT_EQ(std::count(begin, begin + burst.of, true), burst.lost);
            }
            int beginnings = 0;
            for (std::size_t i = 1; i <= burst.of; ++i) beginnings += lost[i] && !lost[i - 1];
            EXPECT_EQ(beginnings, burst.lost < burst.of ? 1 : 0);
        }
    }
}

TEST(BurstLoss, BeginsAnywhereInItsPeriodAndNotTogetherInBothDirections)
{
    constexpr Burst burst{40, 100};
    std::array<int, 4> quarters{};
    int together = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const auto begin_of = [&](Direction direction) {
            const auto lost = losses({.burst_loss = burst}, base::Seed{seed}, direction, 201);
            std::size_t i = 1;
            while (!(lost[i] && !lost[i - 1])) ++i;
            return i % burst.of;
        };
        const auto up = begin_of(Direction::up);
        ++quarters[up / 25];
        together += up == begin_of(Direction::down) ? 1 : 0;
    }
    // Binomial(400, 1/4): mean 100, standard deviation 8.7. Binomial(400, 1/100): mean 4, 2.
    for (const int quarter : quarters) EXPECT_NEAR(quarter, 100, 4 * 8.7);
    EXPECT_NEAR(together, 4, 4 * 2.0);
}

TEST(UniformJitter, IsUniformOnItsWidth)
{
    constexpr std::uint64_t count = 100'000;
    const UniformJitter jitter{15ms, base::Seed{42}.stream("up/jitter")};
    std::vector<double> offsets; // in units of the half width
    for (std::uint64_t number = 0; number < count; ++number) {
        const auto after = std::get<Deliver>(jitter.on_packet(number)).after;
        offsets.push_back(static_cast<double>(after.count()) / 15e6);
    }
    std::sort(offsets.begin(), offsets.end());
    EXPECT_GE(offsets.front(), -1.0);
    EXPECT_LE(offsets.back(), 1.0);
    // Kolmogorov-Smirnov: P(D > 1.95 / sqrt(n)) = 0.001.
    double distance = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const double expected = (offsets[i] + 1.0) / 2.0;
        const double realised = (static_cast<double>(i) + 0.5) / count;
        distance = std::max(distance, std::abs(realised - expected));
    }
    EXPECT_LT(distance, 1.95 / std::sqrt(count));
}

} // namespace hapnet::emulator
