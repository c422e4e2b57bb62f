// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/sweep.hpp"

#include "scene/maths/rotation.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene::sweep_test {
namespace {

Description one_cube()
{
    Description description;
    description.bodies.push_back({.name = "cube"});
    return description;
}

struct OneCube {
    Bodies bodies{one_cube()};
    SweptBoxes boxes{bodies, scales_of({}, bodies)};

    /// Rotates it, and returns its box in the next tick.
    const SweptBox& after_turn(double angle)
    {
        bodies.orientation.put(0, rotated(bodies.orientation.at(0), {angle, 0.0, 0.0}));
        boxes.begin_tick();
        return boxes.at(bodies, 0);
    }
};

TEST(SweptBoxes, KeepTheAxesOfABoxThatTurnsByRounding)
{
    OneCube cube;
    const SweptBox before = cube.after_turn(0.3);
    for (int i = 0; i < 20; ++i) {
        const SweptBox& now = cube.after_turn(5e-15);
        EXPECT_EQ(now.box.axes, before.box.axes);
        EXPECT_EQ(now.turns, before.turns);
    }
}

TEST(SweptBoxes, FindTheAxesOfABoxThatHasTurnedFartherSinceTheyWereFound)
{
    OneCube cube;
    const SweptBox before = cube.after_turn(0.3);
    for (int i = 0; i < 100; ++i) std::ignore = cube.after_turn(5e-15);
    const SweptBox now = cube.after_turn(0.0);
    EXPECT_GT(now.turns, before.turns);
    EXPECT_EQ(now.box.axes, axes_of(now.orientation));
    EXPECT_NE(now.box.axes, before.box.axes);
}

TEST(SweptBoxes, FindTheAxesOfABodyThatWasPutSomewhere)
{
    OneCube cube;
    const SweptBox before = cube.after_turn(0.3);
    cube.boxes.forget(cube.bodies, 0);
    const SweptBox& now = cube.after_turn(5e-15);
    EXPECT_GT(now.turns, before.turns);
    EXPECT_EQ(now.orientation, cube.bodies.orientation.at(0));
}

} // namespace
} // namespace hapnet::scene::sweep_test
