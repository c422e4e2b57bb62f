// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/causality.hpp"
#include "lab/metrics/columns.hpp"
#include "lab/metrics/contact.hpp"
#include "lab/metrics/energy.hpp"
#include "lab/metrics/steps.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

namespace hapnet::lab {
namespace {

constexpr double tick_s = 0.001;

/// A side that rests and touches nothing.
Columns resting(std::size_t count)
{
    Columns side;
    for (auto* column :
         {&side.body_x, &side.body_y, &side.hip_x, &side.hand_force, &side.push, &side.work}) {
        column->assign(count, 0.0);
    }
    side.touching.assign(count, 0);
    side.follows.assign(count, 0);
    return side;
}

Columns pushing(std::size_t count, double newtons)
{
    Columns side = resting(count);
    side.push.assign(count, newtons);
    side.touching.assign(count, 1);
    return side;
}

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
        // 0.1 m/s in the second half; it stands before.
        side.hip_x[i] = carries ? 0.0001 * static_cast<double>(i - 1000) : 0.0;
        side.hand_force[i] = carries ? -0.8 : -0.1;
    }
    EXPECT_NEAR(*drag_of(side, tick_s), 0.8, 1e-12);
    side.touching.assign(2000, 0);
    EXPECT_FALSE(drag_of(side, tick_s));
    EXPECT_FALSE(drag_of(pushing(5000, 1.0), tick_s)); // it only stands
    EXPECT_FALSE(drag_of({}, tick_s));
}

TEST(ForceSteps, AreTheLargestChangeAndWhatTurnsAbruptly)
{
    //                                 +0.6       -0.7 reversal         +0.8 reversal, +0.6 not
    const auto steps = force_steps_of(std::vector{0.0, 0.6, 0.5, -0.2, -0.1, 0.7, 1.3}, tick_s);
    ASSERT_TRUE(steps);
    EXPECT_DOUBLE_EQ(steps->largest_n, 0.8);
    EXPECT_EQ(steps->reversals, 2.0);
}

TEST(ForceSteps, AreThoseOfAMillisecondWhateverTheTick)
{
    EXPECT_DOUBLE_EQ(force_steps_of(std::vector{0.0, 0.3}, 0.0005)->largest_n, 0.6);
    EXPECT_EQ(force_steps_of(std::vector(9, 3.3), tick_s), ForceSteps{});
    EXPECT_FALSE(force_steps_of(std::vector{1.0}, tick_s));
    EXPECT_FALSE(force_steps_of({}, tick_s));
}

TEST(EnergyTaken, IsTheDeepestDeficitOfBothTogether)
{
    // Alone the right hand has got 3 J; together they have got 1 J, after the second tick.
    EXPECT_EQ(energy_taken_of(std::vector{1.0, 1.0, 2.0}, std::vector{0.0, -3.0, 0.0}), 1.0);
    EXPECT_EQ(energy_taken_of(std::vector{1.0, -0.5}, std::vector{0.0, 0.0}), 0.0);
    EXPECT_FALSE(energy_taken_of({}, {}));
}

TEST(EnergyTaken, OfASampledSpringIsWhatItsSamplingMakesUp)
{
    std::vector<Sample> side(201);
    for (std::size_t i = 0; i < side.size(); ++i) {
        const double depth =
            0.00005 * std::min<double>(static_cast<double>(i), 200.0 - static_cast<double>(i));
        side[i].hip.value.x = depth;
        side[i].on_hand.value.x = -500.0 * depth;
    }
    const Columns columns = columns_of(side);
    // The force of a tick is that of its beginning: a tick of pressing stores half of 500 N/m *
    // (50 um)^2 too little, one of releasing gives back as much too much.
    const double made_up = 200 * 0.5 * 500.0 * 0.00005 * 0.00005;
    EXPECT_NEAR(*energy_taken_of(columns.work, std::vector<double>(201, 0.0)), made_up, 1e-12);
}

TEST(Columns, SayWhoFollows)
{
    std::vector<Sample> side(3);
    side[0].remote_touching = true;
    side[1].remote_touching = true;
    side[1].touching = true;
    side[2].holding = true;
    const Columns columns = columns_of(side);
    EXPECT_EQ(columns.follows, (std::vector<std::uint8_t>{1, 0, 0}));
    EXPECT_EQ(columns.touching, (std::vector<std::uint8_t>{0, 1, 1}));
    EXPECT_TRUE(columns_of({}).body_x.empty());
}

TEST(Response, IsTheTimeFromATouchUntilTheOthersBodyMoves)
{
    Columns left = resting(1000);
    Columns right = resting(1000);
    for (std::size_t i = 200; i < 230; ++i) left.touching[i] = 1;
    for (std::size_t i = 240; i < 300; ++i) left.touching[i] = 1; // bounces: no tap of its own
    for (std::size_t i = 263; i < 1000; ++i) right.body_x[i] = 0.005;
    EXPECT_NEAR(*response_of(left, right, tick_s), 0.063, 1e-12);
}

TEST(Response, LooksOnlyAtWhatBeginsAtRest)
{
    Columns left = resting(1000);
    Columns right = resting(1000);
    for (std::size_t i = 200; i < 300; ++i) left.touching[i] = 1;
    EXPECT_FALSE(response_of(left, right, tick_s)); // nothing moves
    for (std::size_t i = 150; i < 1000; ++i) right.body_x[i] = 3e-5 * static_cast<double>(i);
    EXPECT_FALSE(response_of(left, right, tick_s)); // it moves already, at 30 mm/s
    EXPECT_FALSE(response_of(resting(5), resting(5), tick_s));
    EXPECT_FALSE(response_of({}, {}, tick_s));
}

} // namespace
} // namespace hapnet::lab
