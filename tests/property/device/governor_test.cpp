// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor.hpp"

#include "proto/base/random.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t rounds = 200'000;

/// Wishes of every kind: usual, absurd, and any bits at all.
base::Force wish(const base::RandomStream& stream, std::uint64_t round)
{
    base::Force force;
    for (const int axis : {0, 1, 2}) {
        const auto draw = static_cast<std::uint32_t>(axis);
        const double usual = 10.0 * stream.uniform(round, draw) - 5.0;
        const std::uint64_t kind = stream.below(20, round / 100, 10);
        force.value[axis] = kind == 0   ? std::bit_cast<double>(stream.bits(round, draw))
                            : kind == 1 ? 1e300 * usual
                                        : usual;
    }
    return force;
}

TEST(Governor, NeverGivesAHandMoreThanItsLimitsWhateverItIsAskedFor)
{
    const auto stream = base::Seed{1}.stream("governor");
    const GovernorLimits limits;
    Governor governor{limits};
    base::TimePoint now{1h};
    base::Force before;
    Sample sample;
    std::uint64_t felt = 0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        const bool stalls = stream.below(2000, round, 13) == 0;
        const base::Duration elapsed{stream.below(stalls ? 100'000'000 : 2'000'000, round, 11)};
        const bool permitted = stream.below(50, round / 200, 12) != 0;
        now += elapsed;
        ++sample.sequence;
        const base::Force force =
            governor.govern({wish(stream, round), permitted}, sample, now).force();
        ASSERT_TRUE(base::is_finite(force)) << round;
        ASSERT_LE(base::norm(force), limits.force_max_n * (1.0 + 1e-12)) << round;
        const double step_max =
            limits.slew_max_n_per_s * base::to_seconds(std::min(elapsed, limits.tick));
        if (!(force == base::Force{})) {
            ASSERT_LE(base::norm(force - before), step_max + 1e-9) << round;
            ++felt;
        }
        before = force;
    }
    EXPECT_GT(felt, rounds / 2);
}

} // namespace
} // namespace hapnet::device
