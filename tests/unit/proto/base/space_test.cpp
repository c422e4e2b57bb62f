// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/space.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

TEST(Space, TheDifferenceOfTwoPlacesLeadsFromOneToTheOther)
{
    const Position from{{1, 2, 3}};
    const Position to{{4, 6, 8}};
    EXPECT_EQ(to - from, (Displacement{{3, 4, 5}}));
    EXPECT_EQ(from + (to - from), to);
    EXPECT_EQ(to - (to - from), from);
}

TEST(Space, VectorsAddScaleAndTurnAround)
{
    Force force{{1, 2, 3}};
    force += Force{{1, 0, 0}};
    EXPECT_EQ(force, (Force{{2, 2, 3}}));
    EXPECT_EQ(2.0 * force, (Force{{4, 4, 6}}));
    EXPECT_EQ(-force, (Force{{-2, -2, -3}}));
    EXPECT_EQ(force + -force, Force{});
}

TEST(Space, VelocityTimesTimeIsAWayAndForceTimesTimeIsAnImpulse)
{
    EXPECT_EQ((Velocity{{2, 0, -4}} * 500ms), (Displacement{{1, 0, -2}}));
    EXPECT_EQ((Force{{2, 0, -4}} * 250ms), (Impulse{{0.5, 0, -1}}));
}

TEST(Space, TheNormIsTheLength) { EXPECT_EQ(norm(Force{{2, -3, 6}}), 7.0); }

TEST(Space, LimitingKeepsTheDirectionAndLeavesShortVectorsAlone)
{
    EXPECT_EQ(limited(Force{{6, 0, -8}}, 5.0), (Force{{3, 0, -4}}));
    EXPECT_EQ(limited(Force{{6, 0, -8}}, 10.0), (Force{{6, 0, -8}}));
    EXPECT_EQ(limited(Force{}, 0.0), Force{});
}

TEST(Space, OneComponentThatIsNotFiniteIsEnough)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(is_finite(Position{{1, 2, 3}}));
    EXPECT_FALSE(is_finite(Position{{nan, 2, 3}}));
    EXPECT_FALSE(is_finite(Force{{1, -infinity, 3}}));
    EXPECT_FALSE(is_finite(Velocity{{1, 2, nan}}));
}

} // namespace
} // namespace hapnet::base
