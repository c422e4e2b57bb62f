// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/stiffness.hpp"
#include "tests/unit/lab/metrics/waves.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

std::vector<double> scaled(std::vector<double> values, double by)
{
    for (double& value : values) value *= by;
    return values;
}

TEST(Stiffness, StoresOfASpringAndLosesInADamper)
{
    const auto hip = scaled(sine(1.0, 4.0, 0.3), 0.004);
    const auto velocity = scaled(sine(1.0, 4.0, 0.3 + pi / 2), 0.004 * 2.0 * pi);
    std::vector<double> force(hip.size());
    for (std::size_t i = 0; i < force.size(); ++i) {
        force[i] = 0.7 - 120.0 * hip[i] - 5.0 * velocity[i];
    }
    // Only rounding and the turning pointer's drift: some 1e-16 a step.
    const auto felt = stiffness_of(force, hip, 1.0, wave_tick_s);
    EXPECT_NEAR(felt->storage_n_per_m, 120.0, 1e-8);
    EXPECT_NEAR(felt->loss_n_per_m, 5.0 * 2.0 * pi, 1e-8);
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
    const auto felt = stiffness_of(force, hip, 2.0, wave_tick_s);
    EXPECT_NEAR(felt->storage_n_per_m, 80.0, 1e-8);
    EXPECT_NEAR(felt->loss_n_per_m, 0.0, 1e-8);
}

TEST(Stiffness, NeedsAPeriodAndAHandThatMoves)
{
    const auto hip = sine(1.0, 0.9);
    EXPECT_FALSE(stiffness_of(hip, hip, 1.0, wave_tick_s));
    EXPECT_FALSE(stiffness_of({}, {}, 1.0, wave_tick_s));
    EXPECT_FALSE(stiffness_of(sine(1.0, 2.0), scaled(sine(1.0, 2.0), 5e-6), 1.0, wave_tick_s));
}

} // namespace
} // namespace hapnet::lab::metrics
