// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/fit.hpp"

#include "scene/description.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::lab::hands {
namespace {

/// Two hands that come from 0.6 m away to 0.2 m at 1 s, and go back; B rises meanwhile.
std::vector<Motion> approach()
{
    std::vector<Motion> hands(2);
    for (int i = 0; i <= 2000; ++i) {
        const double away = 0.1 + 0.2 * std::abs(1.0 - 1e-3 * i);
        hands[0].emplace_back(1.0 - away, 1.0, 0.0);
        hands[1].emplace_back(1.0 + away, 1.0 + 5e-5 * i, 0.0);
    }
    return hands;
}

TEST(Fit, KnowsWhereAHandTouchesThePapersCube)
{
    const scene::Description paper = scene::paper_scene();
    EXPECT_EQ(touching_m, paper.bodies.front().half.x + paper.hands.radius_m);
}

TEST(Fit, PressesTheCubeWhereTheHandsAreNearest)
{
    auto hands = approach();
    const auto found = fit(hands, {}).value();
    EXPECT_NEAR(found.meeting_s, 1.0, 1e-9);
    EXPECT_NEAR(hands[0][1000].x, -0.021, 1e-12);
    EXPECT_NEAR(hands[1][1000].x, 0.021, 1e-12);
    EXPECT_NEAR(hands[1][1000].y, 0.0, 1e-12);
    // 59 mm of the workspace for 200 mm of way.
    EXPECT_EQ(found.limited_by, "workspace along x");
    EXPECT_NEAR(found.scale, 0.295, 1.1e-4);
    EXPECT_NEAR(hands[0][0].x, -0.021 - found.scale * 0.2, 1e-12);
    // Both touch within 4 mm of the nearest, on either side: 2 * 4 / (0.295 * 0.2) ms.
    EXPECT_NEAR(found.touching_share, 2.0 * 0.004 / (found.scale * 0.2) / 2.0, 2e-3);
    for (const Motion& hand : hands) {
        for (const glm::dvec3& place : hand)
            for (const int axis : {0, 1, 2})
                ASSERT_LE(std::abs(place[axis]), half_workspace_m[axis] + 1e-12);
    }
}

TEST(Fit, KeepsTheSpeedBelowItsLimit)
{
    auto hands = approach(); // at 0.2062 m/s, B
    const auto found = fit(hands, {.speed_max_m_per_s = 0.02}).value();
    EXPECT_EQ(found.limited_by, "speed");
    EXPECT_LE(speed_max_of(hands[1]), 0.02);
    EXPECT_GT(speed_max_of(hands[1]), 0.0199);
}

TEST(Fit, NeverEnlarges)
{
    std::vector<Motion> hands(1);
    for (int i = 0; i < 1000; ++i) hands[0].emplace_back(1e-6 * i, 0.0, 0.0);
    const auto found = fit(hands, {}).value();
    EXPECT_EQ(found.scale, 1.0);
    EXPECT_EQ(found.limited_by, "");
    EXPECT_NEAR(hands[0].back().x, -0.021, 1e-12); // farthest to the right
}

TEST(Fit, RefusesAScaleThatBreaksARuleAndHandsOnTheWrongSides)
{
    auto hands = approach();
    EXPECT_EQ(fit(hands, {.scale = 0.5}).error().message,
              "--scale 0.5: the workspace along x does not allow more than 0.2949: use that, or "
              "--scale fit");
    EXPECT_EQ(fit(hands, {.scale = 0.1}).value().scale, 0.1);
    auto swapped = approach();
    std::swap(swapped[0], swapped[1]);
    EXPECT_EQ(fit(swapped, {}).error().message.find("A's hand is on the right of B's"), 0U);
}

} // namespace
} // namespace hapnet::lab::hands
