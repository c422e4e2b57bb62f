// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/columns.hpp"
#include "lab/metrics/energy.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

std::optional<double> taken(const std::vector<std::vector<double>>& work)
{
    const std::vector<std::span<const double>> hands{work.begin(), work.end()};
    return energy_taken_of(hands);
}

TEST(EnergyTaken, IsTheDeepestDeficitOfAllTogether)
{
    // Alone the right hand gained 3 J. Together they gained 1 J, after the second tick.
    EXPECT_EQ(taken({{1.0, 1.0, 2.0}, {0.0, -3.0, 0.0}}), 1.0);
    EXPECT_EQ(taken({{1.0, -0.5}, {0.0, 0.0}}), 0.0);
    EXPECT_FALSE(taken({{}, {}}));
    EXPECT_FALSE(taken({}));
    // A third hand put in the energy that the right hand gained.
    EXPECT_EQ(taken({{1.0, 1.0, 2.0}, {0.0, -3.0, 0.0}, {0.0, 0.75, 0.0}}), 0.25);
}

TEST(EnergyTaken, OfASampledSpringIsWhatItsSamplingMakesUp)
{
    std::vector<virtual_time::Sample> side(201);
    for (std::size_t i = 0; i < side.size(); ++i) {
        const double depth =
            0.00005 * std::min<double>(static_cast<double>(i), 200.0 - static_cast<double>(i));
        side[i].hip.value.x = depth;
        side[i].on_hand.value.x = -500.0 * depth;
    }
    const Columns columns = columns_of(side);
    // The force of a tick is that of its beginning. So a tick of pressing stores half of 500 N/m *
    // (50 um)^2 too little, and a tick of releasing returns as much too much.
    const double made_up = 200 * 0.5 * 500.0 * 0.00005 * 0.00005;
    EXPECT_NEAR(*taken({columns.work, std::vector<double>(201, 0.0)}), made_up, 1e-12);
}

} // namespace
} // namespace hapnet::lab::metrics
