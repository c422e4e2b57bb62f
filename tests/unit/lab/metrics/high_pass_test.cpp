// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/high_pass.hpp"
#include "tests/unit/lab/metrics/waves.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

constexpr Cutoff above_20_hz{20.0, wave_tick_s};

/// The gain of an analogue Butterworth high-pass at the bilinear transform's frequency.
double gain(int order, double hertz)
{
    const double ratio = std::tan(pi * 20.0 * wave_tick_s) / std::tan(pi * hertz * wave_tick_s);
    return 1.0 / std::sqrt(1.0 + std::pow(ratio, 2 * order));
}

TEST(HighPass, PassesASineAsButterworthSays)
{
    // Whole periods. The transient weighs 1 in 60 s / 10 ms.
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
    EXPECT_FALSE(band_vibration_of({}, above_20_hz, {300.0, wave_tick_s}));
}

TEST(HighPass, ABandLosesWhatLiesOnEitherSide)
{
    const Cutoff below{300.0, wave_tick_s};
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

} // namespace
} // namespace hapnet::lab::metrics
