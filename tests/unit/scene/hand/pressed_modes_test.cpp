// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/pressed_modes.hpp"

#include "tests/support/scene/dice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::pressed_modes_test {
namespace {

using Each = std::array<double, 2>;

Each each(Two a) { return {a[0], a[1]}; }

PressedModes::Key random_key(test::Dice& dice, int springs)
{
    PressedModes::Key key{.stiffness = std::pow(10.0, dice.between(2.0, 4.0)),
                          .damping = dice.between(0.0, 5.0),
                          .tick = 1e-3};
    key.own[0] = dice.between(1.0, 20.0);
    if (springs == 1) return key;
    key.own[1] = dice.between(1.0, 20.0);
    key.mutual = dice.between(-0.99, 0.99) * std::sqrt(key.own[0] * key.own[1]);
    return key;
}

PressedModes::Start random_start(test::Dice& dice, int springs)
{
    const auto draw = [&](double least, double most) {
        const double one = dice.between(least, most);
        return Two{one, springs == 2 ? dice.between(least, most) : 0.0};
    };
    const Two depth = draw(0.0, 5e-3), speed = draw(-0.1, 0.1);
    return {depth, speed, draw(-20.0, 20.0)};
}

/// Runge and Kutta's rule in small steps. Also finds the largest change of the forces.
struct Reference {
    Each impulse{}, moment{}, change{};
};
Reference integrate(const PressedModes::Key& key, const PressedModes::Start& start)
{
    constexpr int steps = 1000;
    const double h = key.tick / steps;
    using State = std::array<Each, 4>; // depth, speed, impulse, moment
    const auto force = [&](const State& s, std::size_t i) {
        return key.stiffness * s[0][i] + key.damping * s[1][i];
    };
    const auto rate = [&](const State& s) {
        const Each f{force(s, 0), key.own[1] > 0.0 ? force(s, 1) : 0.0};
        State r{};
        r[0] = s[1];
        r[1] = {start.acceleration[0] - key.own[0] * f[0] - key.mutual * f[1],
                start.acceleration[1] - key.mutual * f[0] - key.own[1] * f[1]};
        r[2] = f;
        r[3] = s[2];
        return r;
    };
    const auto plus = [](const State& s, double by, const State& r) {
        State sum = s;
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t i = 0; i < 2; ++i) sum[k][i] += by * r[k][i];
        return sum;
    };
    State s{each(start.depth), each(start.speed), {}, {}};
    const State first = s;
    Reference reference;
    for (int n = 0; n < steps; ++n) {
        const State a = rate(s), b = rate(plus(s, h / 2, a)), c = rate(plus(s, h / 2, b)),
                    d = rate(plus(s, h, c));
        s = plus(plus(plus(plus(s, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
        for (std::size_t i = 0; i < 2; ++i)
            reference.change[i] =
                std::max(reference.change[i], std::abs(force(s, i) - force(first, i)));
    }
    reference.impulse = s[2];
    reference.moment = s[3];
    return reference;
}

TEST(PressedModes, AreTheSolutionOfTheSpringsEquations)
{
    test::Dice dice{base::Seed{1}.stream("modes")};
    int solved = 0;
    for (int i = 0; i < 100; ++i) {
        const int springs = 1 + i % 2;
        const PressedModes::Key key = random_key(dice, springs);
        const PressedModes::Start start = random_start(dice, springs);
        PressedModes modes;
        if (!modes.find(key)) continue;
        ++solved;
        const auto outcome = modes.outcome(start);
        const Reference expected = integrate(key, start);
        const Each impulse = each(outcome.impulse), moment = each(outcome.moment),
                   change = each(outcome.change);
        const double force = key.stiffness * 5e-3 + key.damping * 0.1;
        for (int k = 0; k < springs; ++k) {
            const auto at = static_cast<std::size_t>(k);
            EXPECT_NEAR(impulse[at], expected.impulse[at], 1e-13 * force * key.tick);
            EXPECT_NEAR(moment[at], expected.moment[at], 1e-13 * force * key.tick * key.tick);
            EXPECT_GE(change[at], expected.change[at] * (1.0 - 1e-9));
        }
    }
    EXPECT_GT(solved, 70);
}

TEST(PressedModes, ThatAreKeptHaveTheBitsOfNewOnes)
{
    test::Dice dice{base::Seed{2}.stream("modes")};
    PressedModes kept;
    PressedModes::Key key = random_key(dice, 2);
    for (int i = 0; i < 500; ++i) {
        if (dice.between(0.0, 1.0) < 0.3) key = random_key(dice, 1 + i % 2);
        const PressedModes::Start start = random_start(dice, key.own[1] > 0.0 ? 2 : 1);
        PressedModes fresh;
        ASSERT_EQ(kept.find(key), fresh.find(key));
        const auto a = kept.outcome(start), b = fresh.outcome(start);
        EXPECT_EQ(each(a.impulse), each(b.impulse));
        EXPECT_EQ(each(a.moment), each(b.moment));
        EXPECT_EQ(each(a.change), each(b.change));
    }
}

TEST(PressedModes, OfAMirroredSqueezeAreMirrored)
{
    PressedModes modes;
    ASSERT_TRUE(modes.find({Two{10.0, 10.0}, -10.0, 1000.0, 2.0, 1e-3}));
    const auto outcome = modes.outcome({both(1e-3), both(0.02), both(3.0)});
    EXPECT_EQ(outcome.impulse[0], outcome.impulse[1]);
    EXPECT_EQ(outcome.moment[0], outcome.moment[1]);
}

TEST(PressedModes, RefuseATickThatIsLongForTheSprings)
{
    PressedModes modes;
    EXPECT_FALSE(modes.find({Two{10.0, 0.0}, 0.0, 1e6, 0.0, 1e-3}));
    EXPECT_TRUE(modes.find({Two{10.0, 0.0}, 0.0, 1e4, 0.0, 1e-3}));
}

} // namespace
} // namespace hapnet::scene::pressed_modes_test
