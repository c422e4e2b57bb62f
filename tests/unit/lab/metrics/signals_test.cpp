// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/high_pass.hpp"
#include "lab/metrics/similarity.hpp"
#include "lab/metrics/spread.hpp"
#include "lab/metrics/stiffness.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

namespace hapnet::lab::signals_test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double tick_s = 0.001;
constexpr Cutoff above_20_hz{20.0, tick_s};

/// Of amplitude 1.
std::vector<double> sine(double hertz, double seconds, double phase = 0.0)
{
    std::vector<double> values(static_cast<std::size_t>(seconds / tick_s + 0.5));
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = std::sin(2.0 * pi * hertz * static_cast<double>(i) * tick_s + phase);
    }
    return values;
}

std::vector<double> scaled(std::vector<double> values, double by)
{
    for (double& value : values) value *= by;
    return values;
}

/// Of an analogue Butterworth high-pass, at the frequency to which the bilinear transform maps.
double gain(int order, double hertz)
{
    const double ratio = std::tan(pi * 20.0 * tick_s) / std::tan(pi * hertz * tick_s);
    return 1.0 / std::sqrt(1.0 + std::pow(ratio, 2 * order));
}

TEST(HighPass, PassesASineAsButterworthSays)
{
    // Whole periods; what swings in weighs 1 in 60 s / 10 ms.
    for (const double hertz : {1.0, 5.0, 20.0, 80.0}) {
        const auto vibration = vibration_of(sine(hertz, 60.0), {}, above_20_hz);
        ASSERT_TRUE(vibration);
        EXPECT_NEAR(vibration->first, std::sqrt(0.5) * gain(1, hertz), 2e-3) << hertz;
        EXPECT_NEAR(vibration->second, std::sqrt(0.5) * gain(2, hertz), 2e-3) << hertz;
        EXPECT_NEAR(vibration->fourth, std::sqrt(0.5) * gain(4, hertz), 2e-3) << hertz;
    }
}

TEST(HighPass, ShowsNothingOfAConstantNotEvenAtTheBeginning)
{
    const auto vibration = vibration_of(std::vector<double>(100, 0.375), {}, above_20_hz);
    ASSERT_TRUE(vibration);
    EXPECT_EQ(*vibration, ByOrder{});
}

TEST(HighPass, CountsOnlyTheMarkedSamples)
{
    std::vector<double> signal(1000, 0.0);
    std::vector<std::uint8_t> counts(1000, 1);
    signal[600] = 1.0; // has died away by 1e-7 at 900
    for (std::size_t i = 590; i < 900; ++i) counts[i] = 0;
    const auto vibration = vibration_of(signal, counts, above_20_hz);
    ASSERT_TRUE(vibration);
    EXPECT_LT(vibration->fourth, 1e-7);
    EXPECT_GT(vibration_of(signal, {}, above_20_hz)->fourth, 1e-2);
}

TEST(HighPass, HasNothingToSayWhereNothingCounts)
{
    EXPECT_FALSE(vibration_of({}, {}, above_20_hz));
    EXPECT_FALSE(
        vibration_of(std::vector<double>(3, 1.0), std::vector<std::uint8_t>(3, 0), above_20_hz));
    EXPECT_FALSE(band_vibration_of({}, above_20_hz, {300.0, tick_s}));
}

TEST(HighPass, ABandLosesWhatLiesOnEitherSide)
{
    const Cutoff below{300.0, tick_s};
    EXPECT_NEAR(*band_vibration_of(sine(77.0, 10.0), above_20_hz, below), std::sqrt(0.5), 0.01);
    EXPECT_LT(*band_vibration_of(sine(1.0, 10.0), above_20_hz, below), 0.005);
    EXPECT_LT(*band_vibration_of(sine(480.0, 10.0), above_20_hz, below), 0.01);
    EXPECT_EQ(*band_vibration_of(std::vector<double>(50, 2.0), above_20_hz, below), 0.0);
}

TEST(HighPass, GivesTheSameBitsEverywhere)
{
    std::vector<double> ramp;
    for (int i = 0; i < 500; ++i) ramp.push_back((i * 7919) % 101 * 0.01);
    const auto vibration = vibration_of(ramp, {}, above_20_hz);
    ASSERT_TRUE(vibration);
    EXPECT_EQ(vibration->first, 0x1.2af9d1e59a66ap-2);
    EXPECT_EQ(vibration->second, 0x1.2acebca9164eep-2);
    EXPECT_EQ(vibration->fourth, 0x1.2afccce223afcp-2);
}

TEST(Stiffness, OfASpringIsItsConstantAndOfADamperNothing)
{
    const auto hip = scaled(sine(1.0, 4.0, 0.3), 0.004);
    const auto velocity = scaled(sine(1.0, 4.0, 0.3 + pi / 2), 0.004 * 2.0 * pi);
    std::vector<double> force(hip.size());
    for (std::size_t i = 0; i < force.size(); ++i) {
        force[i] = 0.7 - 120.0 * hip[i] - 5.0 * velocity[i];
    }
    // Only rounding and the turning pointer's drift: some 1e-16 a step.
    EXPECT_NEAR(*stiffness_of(force, hip, 1.0, tick_s), 120.0, 1e-8);
}

TEST(Stiffness, IsMeasuredOverWholePeriodsAndIgnoresOtherFrequencies)
{
    auto hip = scaled(sine(2.0, 2.7), 0.003);
    const auto other = scaled(sine(6.0, 2.7), 0.002);
    std::vector<double> force(hip.size());
    for (std::size_t i = 0; i < force.size(); ++i) {
        force[i] = -80.0 * hip[i] + 300.0 * other[i];
        hip[i] += other[i];
    }
    EXPECT_NEAR(*stiffness_of(force, hip, 2.0, tick_s), 80.0, 1e-8);
}

TEST(Stiffness, NeedsAPeriodAndAHandThatMoves)
{
    const auto hip = sine(1.0, 0.9);
    EXPECT_FALSE(stiffness_of(hip, hip, 1.0, tick_s));
    EXPECT_FALSE(stiffness_of({}, {}, 1.0, tick_s));
    EXPECT_FALSE(stiffness_of(sine(1.0, 2.0), scaled(sine(1.0, 2.0), 5e-6), 1.0, tick_s));
}

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
    const auto same = similarity_of(pressing(10.0, 0.0), pressing(10.0, 0.160), tick_s);
    ASSERT_TRUE(same);
    EXPECT_NEAR(same->share, 1.0, 1e-9);
    EXPECT_NEAR(same->lag_s, 0.160, 1e-9);
}

TEST(Similarity, SinksWhereTheForceBuzzes)
{
    auto buzzing = pressing(10.0, 0.050);
    const auto buzz = sine(120.0, 10.0);
    for (std::size_t i = 0; i < buzzing.size(); ++i) buzzing[i] += 0.3 * buzz[i];
    const auto similarity = similarity_of(pressing(10.0, 0.0), buzzing, tick_s);
    ASSERT_TRUE(similarity);
    EXPECT_LT(similarity->share, 0.6);
    EXPECT_NEAR(similarity->lag_s, 0.050, 0.003);
}

TEST(Similarity, HasNothingToSayOfShortSignalsOrNone)
{
    EXPECT_FALSE(similarity_of({}, {}, tick_s));
    EXPECT_FALSE(similarity_of(pressing(0.9, 0.0), pressing(0.9, 0.0), tick_s));
    const std::vector<double> nothing(5000, 0.0);
    EXPECT_FALSE(similarity_of(nothing, nothing, tick_s));
}

TEST(Similarity, OfConstantForcesIsThatOfTheirMeans)
{
    const auto similarity =
        similarity_of(std::vector<double>(5000, 1.0), std::vector<double>(5000, 1.0), tick_s);
    ASSERT_TRUE(similarity);
    EXPECT_NEAR(similarity->share, 1.0, 1e-9);
    EXPECT_EQ(similarity->lag_s, 0.0);
}

TEST(Spread, IsThatOfThePopulation)
{
    const auto spread = spread_of(std::vector{1.0, 2.0, 3.0, 6.0});
    ASSERT_TRUE(spread);
    EXPECT_EQ(spread->mean, 3.0);
    EXPECT_EQ(spread->min, 1.0);
    EXPECT_EQ(spread->max, 6.0);
    EXPECT_EQ(spread->std, std::sqrt(3.5));
    EXPECT_FALSE(spread_of({}));
}

} // namespace
} // namespace hapnet::lab::signals_test
