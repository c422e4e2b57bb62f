// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_noise.hpp"

#include "proto/base/math.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

constexpr std::uint32_t swings_each = 3;

} // namespace

HandNoise::HandNoise(base::Seed seed, std::uint16_t peer_id)
{
    const auto wander = seed.stream(fmt::format("peer/{}/wander", peer_id));
    const auto tremor = seed.stream(fmt::format("peer/{}/tremor", peer_id));
    for (std::uint32_t i = 0; i < swings_each; ++i) {
        swings_[i] = {.amplitude_m = 2e-3 / swings_each,
                      .hertz = 0.3 + 0.6 * wander.uniform(i, 0),
                      .phase = base::two_pi * wander.uniform(i, 1)};
        swings_[swings_each + i] = {.amplitude_m = 1e-4 / swings_each,
                                    .hertz = 8.0 + 4.0 * tremor.uniform(i, 0),
                                    .phase = base::two_pi * tremor.uniform(i, 1)};
    }
}

double HandNoise::at(double seconds) const
{
    double sum = 0.0;
    for (const Swing& s : swings_) {
        const double turns = s.hertz * seconds;
        // Whole turns taken off: the sine's range would end after some hours.
        sum += s.amplitude_m * base::sin(base::two_pi * (turns - std::floor(turns)) + s.phase);
    }
    return sum;
}

} // namespace hapnet::device
