// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/steps.hpp"
#include "tests/unit/lab/metrics/columns_of_a_hand.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

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

} // namespace
} // namespace hapnet::lab::metrics
