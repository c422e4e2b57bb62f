// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_noise.hpp"

#include "proto/base/math.hpp"

#include <cmath>
#include <span>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

constexpr double force_least_hertz = 1.0;
constexpr double force_most_hertz = 10.0;

} // namespace

HandNoise::HandNoise(base::Seed seed, std::uint16_t peer_id, const Operator& person)
    : wander_m_{person.wander.amplitude_m / swings_each},
      tremor_m_{person.tremor.amplitude_m / swings_each},
      // Three sines of this amplitude have the standard deviation sqrt(3/2) of it.
      force_share_{person.force_noise.fraction() * std::sqrt(2.0 / swings_each)}
{
    const auto set = [&](std::size_t first, std::string_view name, double least, double most) {
        const auto stream = seed.stream(fmt::format("peer/{}/{}", peer_id, name));
        for (std::size_t i = 0; i < swings_each; ++i) {
            hertz_[first + i] = least + (most - least) * stream.uniform(i, 0);
            turn_[first + i] = stream.uniform(i, 1);
        }
    };
    set(0, "wander", person.wander.least_hertz, person.wander.most_hertz);
    set(swings_each, "tremor", person.tremor.least_hertz, person.tremor.most_hertz);
    set(2 * swings_each, "force", force_least_hertz, force_most_hertz);
}

HandNoise::Value HandNoise::at(double seconds) const
{
    std::array<double, swings> sines{};
    for (std::size_t i = 0; i < swings; ++i) sines[i] = hertz_[i] * seconds + turn_[i];
    const bool is_even = force_share_ == 0.0;
    base::sines_of_turns(std::span{sines}.first(is_even ? 2 * swings_each : swings));
    Value value{.away_m = wander_m_ * (sines[0] + sines[1] + sines[2]) +
                          tremor_m_ * (sines[3] + sines[4] + sines[5])};
    if (!is_even) value.force_share = force_share_ * (sines[6] + sines[7] + sines[8]);
    return value;
}

} // namespace hapnet::device
