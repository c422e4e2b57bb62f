// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_motion.hpp"

#include "proto/base/math.hpp"
#include "proto/base/random.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

constexpr std::uint64_t hands = 5000;

/// Draws a value evenly in the logarithm.
double within(double least, double most, double share)
{
    return base::exp(base::log(least) + share * (base::log(most) - base::log(least)));
}

TEST(HandMotion, IsFiniteAndTheSameInTwoHalvesForEveryHandThatCanBeAskedFor)
{
    const auto stream = base::Seed{1}.stream("hand");
    for (std::uint64_t i = 0; i < hands; ++i) {
        const auto draw = [&](std::uint32_t n) { return stream.uniform(i, n); };
        const HandImpedance hand{within(0.02, 10.0, draw(0)), within(1e-6, 100.0, draw(1)),
                                 within(1.0, 5000.0, draw(2))};
        // Without friction. A motion that ends within a step ends only once.
        HandMotion whole{hand, 0.0};
        HandMotion half{hand, 0.0};
        whole.set_step(2e-3);
        half.set_step(1e-3);
        HandAxis once{0.1 * draw(3) - 0.05, draw(4) - 0.5};
        HandAxis twice = once;
        const HandDrive drive{6.0 * draw(5) - 3.0, 0.1 * draw(6) - 0.05, draw(7) - 0.5};
        whole.advance(once, drive);
        half.advance(twice, drive);
        const double halfway = drive.target_m + 1e-3 * drive.target_velocity_m_per_s;
        half.advance(twice, {drive.force_n, halfway, drive.target_velocity_m_per_s});
        ASSERT_TRUE(std::isfinite(once.position_m + once.velocity_m_per_s)) << i;
        ASSERT_NEAR(once.position_m, twice.position_m, 1e-14) << i;
        ASSERT_NEAR(once.velocity_m_per_s, twice.velocity_m_per_s, 1e-11) << i;
    }
}

TEST(HandMotion, NeverGainsEnergyOnItsOwn)
{
    const auto stream = base::Seed{2}.stream("hand");
    for (std::uint64_t i = 0; i < hands; ++i) {
        const auto draw = [&](std::uint32_t n) { return stream.uniform(i, n); };
        const HandImpedance hand{0.2, within(1e-6, 100.0, draw(1)), within(50.0, 1000.0, draw(2))};
        HandMotion motion{hand, 0.26};
        motion.set_step(1e-3);
        HandAxis axis{0.02 * draw(3) - 0.01, 0.2 * draw(4) - 0.1};
        const auto energy = [&] {
            return 0.5 * (hand.mass_kg * axis.velocity_m_per_s * axis.velocity_m_per_s +
                          hand.stiffness_n_per_m * axis.position_m * axis.position_m);
        };
        double before = energy();
        for (int ms = 0; ms < 50; ++ms) {
            motion.advance(axis, {});
            const double now = energy();
            ASSERT_LE(now, before + 1e-12) << i << ' ' << ms;
            before = now;
        }
    }
}

} // namespace
} // namespace hapnet::device
