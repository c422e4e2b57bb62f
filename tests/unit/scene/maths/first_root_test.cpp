// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/maths/first_root.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

class FirstRoot : public testing::Test {
protected:
    static constexpr double tick = 1e-3;
    Propagator propagator_{{.stiffness = 1e8}, tick}; // 1.6 periods a tick
    Trajectories trajectories_{Trajectory{&propagator_, 1.0, 0.0, 0.0}, Trajectory{}, Trajectory{}};
    WatchedQuantity watch_;

    std::optional<double> root() { return first_root(watch_, trajectories_, 0.0, tick); }
};

TEST_F(FirstRoot, IsTheFirstOfMany)
{
    watch_.level = 0.5e-4; // the way is sin(1e4 t) / 1e4
    watch_.displacement_weight[0] = 1.0;
    const auto found = root();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, 3.66519142918809213e-4, 1e-15); // 7 pi / 6
}

TEST_F(FirstRoot, IsNotThereWhereTheWaveStaysJustAbove)
{
    watch_.level = 1.0000001e-4;
    watch_.displacement_weight[0] = 1.0;
    EXPECT_FALSE(root());
}

TEST_F(FirstRoot, IsFoundWhereTheWaveOnlyJustGetsThere)
{
    watch_.level = 0.9999999e-4;
    watch_.displacement_weight[0] = 1.0;
    const auto found = root();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, (4.71238898038468986 - std::acos(0.9999999)) * 1e-4, 1e-12);
}

TEST_F(FirstRoot, IsAtOnceWhenItFallsFromZero)
{
    watch_.displacement_weight[0] = -1.0;
    EXPECT_EQ(root(), 0.0);
}

TEST_F(FirstRoot, IsTheReturnWhenItRisesFromZero)
{
    watch_.displacement_weight[0] = 1.0;
    const auto found = root();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, 3.14159265358979324e-4, 1e-15);
}

TEST_F(FirstRoot, TakesTheNonzeroLevelOfAnythingThatStandsStill)
{
    trajectories_[0] = {};
    watch_.level = 1.0;
    watch_.slope = -4000.0;
    EXPECT_EQ(root(), 2.5e-4);
    watch_.slope = -999.0;
    EXPECT_FALSE(root());
}

TEST_F(FirstRoot, IsGivenUpWhenItsStepsAreSpentAndSaysHowFarItLooked)
{
    watch_.level = 0.9999999e-4; // so close that it takes more than two steps
    watch_.displacement_weight[0] = 1.0;
    int steps = 2;
    const RootSearch search = search_root(watch_, trajectories_, 0.0, tick, steps);
    EXPECT_EQ(search.end, RootSearch::End::given_up);
    EXPECT_EQ(steps, 0);
    EXPECT_GT(search.time, 0.0);
    EXPECT_LT(search.time, *root());
    const RootSearch next = search_root(watch_, trajectories_, 0.0, tick, steps);
    EXPECT_EQ(next.end, RootSearch::End::given_up);
    EXPECT_EQ(next.time, 0.0);
}

} // namespace
} // namespace hapnet::scene
