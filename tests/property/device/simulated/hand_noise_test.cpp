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
        const HandNoise noise{base::Seed{seed}, 1, {}};
        double most = 0.0;
        for (int ms = -1000; ms < 20'000; ms += 10) {
            most = std::max(most, std::abs(noise.at(1e-3 * ms).away_m));
        }
        EXPECT_LE(most, amplitude_m) << seed;
        EXPECT_GE(most, 0.3 * amplitude_m) << seed;
    }
}

TEST(HandNoise, IsThereForTheLongestSessionThatCanBeAskedFor)
{
    const HandNoise noise{base::Seed{1}, 1, {}};
    for (const double seconds : {13'000.0, 14'000.0, 1e5, 1e6}) {
        double most = 0.0;
        for (int i = 0; i < 400; ++i)
            most = std::max(most, std::abs(noise.at(seconds + 0.01 * i).away_m));
        EXPECT_LE(most, amplitude_m) << seconds;
        EXPECT_GE(most, 0.1 * amplitude_m) << seconds;
    }
}

TEST(HandNoise, DiffersBetweenSeedsAndBetweenPeers)
{
    const auto at_one_second = [](std::uint64_t seed, std::uint16_t peer_id) {
        return HandNoise{base::Seed{seed}, peer_id, {}}.at(1.0).away_m;
    };
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        EXPECT_NE(at_one_second(seed, 1), at_one_second(seed, 2));
        EXPECT_NE(at_one_second(seed, 1), at_one_second(seed + 1, 1));
        EXPECT_EQ(at_one_second(seed, 1), at_one_second(seed, 1));
    }
}

} // namespace
} // namespace hapnet::device
