// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/contact.hpp"
#include "tests/unit/lab/metrics/columns_of_a_hand.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

TEST(ForceDiscrepancy, IsTheMeanDistanceOverTheMeanForce)
{
    EXPECT_NEAR(*force_discrepancy_of(pushing(10, 0.9), pushing(10, 1.1)), 0.2, 1e-15);
    EXPECT_EQ(*force_discrepancy_of(pushing(10, 0.5), pushing(10, 0.5)), 0.0);
}

TEST(ForceDiscrepancy, LooksOnlyWhereBothTouch)
{
    Columns left = pushing(10, 1.0);
    left.touching.assign(10, 0);
    EXPECT_FALSE(force_discrepancy_of(left, pushing(10, 1.0)));
    left.touching[3] = 1;
    EXPECT_EQ(*force_discrepancy_of(left, pushing(10, 1.0)), 0.0);
    EXPECT_FALSE(force_discrepancy_of({}, {}));
}

TEST(ContactLost, IsTheShareOfTimeBelowTwoHundredthsOfANewton)
{
    EXPECT_EQ(contact_lost_of(std::vector{0.0, 0.019, 0.02, 1.0}), 0.5);
    EXPECT_FALSE(contact_lost_of({}));
}

TEST(Drag, IsTheForceAtATenthOfAMetrePerSecond)
{
    Columns side = pushing(2000, 1.0);
    for (std::size_t i = 0; i < 2000; ++i) {
        const bool carries = i >= 1000;
        // 0.1 m/s in the second half; at rest before.
        side.hip_x[i] = carries ? 0.0001 * static_cast<double>(i - 1000) : 0.0;
        side.hand_force[i] = carries ? -0.8 : -0.1;
    }
    EXPECT_NEAR(*drag_of(side, tick_s), 0.8, 1e-12);
    side.touching.assign(2000, 0);
    EXPECT_FALSE(drag_of(side, tick_s));
    EXPECT_FALSE(drag_of(pushing(5000, 1.0), tick_s)); // it only rests
    EXPECT_FALSE(drag_of({}, tick_s));
}

} // namespace
} // namespace hapnet::lab::metrics
