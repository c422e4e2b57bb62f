// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_noise.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

constexpr double amplitude_m = 0.0021; // 2 mm of wander and 0.1 mm of tremor

TEST(HandNoise, StaysWithinItsAmplitudeForEverySeed)
{
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const HandNoise noise{base::Seed{seed}, 1};
        double most = 0.0;
        for (int ms = -1000; ms < 20'000; ms += 10) {
            most = std::max(most, std::abs(noise.at(1e-3 * ms)));
        }
        EXPECT_LE(most, amplitude_m) << seed;
        EXPECT_GE(most, 0.3 * amplitude_m) << seed;
    }
}

TEST(HandNoise, IsThereForTheLongestSessionThatCanBeAskedFor)
{
    const HandNoise noise{base::Seed{1}, 1};
    for (const double seconds : {13'000.0, 14'000.0, 1e5, 1e6}) {
        double most = 0.0;
        for (int i = 0; i < 400; ++i) most = std::max(most, std::abs(noise.at(seconds + 0.01 * i)));
        EXPECT_LE(most, amplitude_m) << seconds;
        EXPECT_GE(most, 0.1 * amplitude_m) << seconds;
    }
}

TEST(HandNoise, DiffersBetweenSeedsAndBetweenPeers)
{
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const HandNoise one{base::Seed{seed}, 1};
        EXPECT_NE(one.at(1.0), (HandNoise{base::Seed{seed}, 2}.at(1.0)));
        EXPECT_NE(one.at(1.0), (HandNoise{base::Seed{seed + 1}, 1}.at(1.0)));
        EXPECT_EQ(one.at(1.0), (HandNoise{base::Seed{seed}, 1}.at(1.0)));
    }
}

} // namespace
} // namespace hapnet::device
