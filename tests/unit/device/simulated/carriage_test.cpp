// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/carriage.hpp"

#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

constexpr std::array way{Waypoint{0.0, -0.05, 0.0}, Waypoint{1.0, -0.05, 0.0},
                         Waypoint{3.0, -0.05, 0.04}, Waypoint{5.0, 0.05, 0.04}};
constexpr Carriage carriage{way, 1.0, 4.0};

TEST(Carriage, GoesFromPointToPointAndStopsAtEach)
{
    const auto place = [](double t) { return carried(carriage, t).target; };
    EXPECT_EQ(place(-1.0), (base::Position{{-0.05, 0.0, 0.0}}));
    EXPECT_EQ(place(1.0), (base::Position{{-0.05, 0.0, 0.0}}));
    EXPECT_NEAR(place(2.0).y(), 0.02, 1e-12); // half of the time, half of the way
    EXPECT_EQ(place(3.0), (base::Position{{-0.05, 0.04, 0.0}}));
    EXPECT_NEAR(place(3.001).x(), -0.05, 1e-9); // from rest
    EXPECT_NEAR(place(4.0).x(), 0.0, 1e-12);
    EXPECT_NEAR(place(9.0).x(), 0.05, 1e-12);
}

TEST(Carriage, GripsFromOneTimeToAnother)
{
    EXPECT_FALSE(carried(carriage, 0.999).gripping);
    EXPECT_TRUE(carried(carriage, 1.0).gripping);
    EXPECT_TRUE(carried(carriage, 3.999).gripping);
    EXPECT_FALSE(carried(carriage, 4.0).gripping);
}

} // namespace
} // namespace hapnet::device
