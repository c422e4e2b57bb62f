// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/motion_figures.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace hapnet::lab::hands {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// A sine along x for 20 s.
Places sine(double hertz, double amplitude_m)
{
    Places places;
    for (int i = 0; i <= 1000; ++i)
        places.emplace_back(amplitude_m * std::sin(turn * hertz * i / figures_rate_hz), 0.0, 0.0);
    return places;
}

TEST(MotionFigures, OfASineAreThoseOfItsFormula)
{
    const MotionFigures figures = figures_of(sine(1.0, 0.010));
    EXPECT_NEAR(figures.spread_x_mm, 10.0 / std::sqrt(2.0), 0.01);
    EXPECT_EQ(figures.spread_y_mm, 0.0);
    EXPECT_NEAR(figures.speed_mm_s, 10.0 * turn / std::sqrt(2.0), 0.1);
    EXPECT_NEAR(figures.speed_max_mm_s, 10.0 * turn, 0.2);
    EXPECT_NEAR(figures.half_power_hz, 1.0, 0.02);
    EXPECT_NEAR(figures.most_power_hz, 1.0, 0.4); // a window of 4 s leaks into its neighbours
    EXPECT_NEAR(figures.peaks_per_s, 2.0, 0.1);   // the first and the last are at the ends
}

TEST(MotionFigures, HaveTheTimeBelowATenthOfTheSpeedAsRest)
{
    // |cos| is below a tenth of its 95 % quantile, 0.9969. The places meet all phases.
    EXPECT_NEAR(figures_of(sine(0.7310, 0.010)).rest_share, 4.0 / turn * std::asin(0.09969), 0.005);
}

TEST(MotionFigures, TellWhichPartOfTheSpeedIsFast)
{
    Places both = sine(0.5, 0.010);
    const Places fast = sine(4.0, 0.010 / 8.0); // the same speed
    for (std::size_t i = 0; i < both.size(); ++i) both[i].y = fast[i].x;
    const MotionFigures figures = figures_of(both);
    EXPECT_GT(figures.half_power_hz, 0.5);
    EXPECT_LT(figures.half_power_hz, 4.1);
    EXPECT_NEAR(figures.most_power_hz, 4.0, 0.2);
}

TEST(MotionFigures, OfAHandAtRestAreZero)
{
    const MotionFigures figures = figures_of(Places(100, glm::dvec3{0.5}));
    EXPECT_NEAR(figures.spread_x_mm, 0.0, 1e-9);
    EXPECT_EQ(figures.speed_max_mm_s, 0.0);
    EXPECT_EQ(figures.peaks_per_s, 0.0);
    EXPECT_TRUE(std::isfinite(figures.half_power_hz));
}

TEST(MotionFigures, HaveAShortMotionInOneWindow)
{
    const Places whole = sine(1.0, 0.010);
    const MotionFigures figures = figures_of({whole.begin(), whole.begin() + 60});
    EXPECT_NEAR(figures.half_power_hz, 1.0, 0.4);
    EXPECT_NO_FATAL_FAILURE(std::ignore = figures_of({whole.begin(), whole.begin() + 3}));
}

TEST(Sampled, KeepsEachTwentiethMillisecond)
{
    Motion motion;
    for (int i = 0; i <= 100; ++i) motion.emplace_back(i, 0.0, 0.0);
    const Places places = sampled(motion);
    ASSERT_EQ(places.size(), 6U);
    EXPECT_EQ(places[5].x, 100.0);
}

} // namespace
} // namespace hapnet::lab::hands
