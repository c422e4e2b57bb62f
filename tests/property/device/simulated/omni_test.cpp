// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/omni.hpp"

#include "proto/base/random.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

TEST(SimulatedOmni, StaysFiniteAndInItsWorkspaceWhateverForceAndTimeDoToIt)
{
    constexpr double half_count = 0.000055 / 2;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto stream = base::Seed{seed}.stream("omni");
        const bool is_left = seed % 2 == 0;
        const auto name = seed % 3 == 0 ? "lifelike" : seed % 3 == 1 ? "firm" : "relaxed";
        SimulatedOmni omni{{.task = all_tasks.at(seed % all_tasks.size()),
                            .person = operator_named(name).value()}};
        base::TimePoint now{1h};
        omni.on_cue({now + 500ms, 3s, base::Seed{seed}, 1, is_left});
        const double centre = is_left ? -0.025 : 0.025;
        for (std::uint64_t tick = 0; tick < 3000; ++tick) {
            const bool stalls = stream.below(200, tick, 0) == 0;
            now += base::Duration{stream.below(stalls ? 200'000'000 : 2'000'000, tick, 1)};
            const Sample sample = omni.read(now);
            ASSERT_TRUE(base::is_finite(sample.hip) && base::is_finite(sample.velocity)) << seed;
            ASSERT_LE(std::abs(sample.hip.x() - centre), 0.080 + half_count) << seed;
            ASSERT_LE(std::abs(sample.hip.y()), 0.060 + half_count) << seed;
            ASSERT_LE(std::abs(sample.hip.z()), 0.035 + half_count) << seed;
            omni.apply(ungoverned({{20.0 * stream.uniform(tick / 50, 2) - 10.0,
                                    20.0 * stream.uniform(tick / 50, 3) - 10.0,
                                    20.0 * stream.uniform(tick / 50, 4) - 10.0}}));
        }
    }
}

} // namespace
} // namespace hapnet::device
