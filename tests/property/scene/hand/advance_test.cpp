// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"
#include "proto/base/space.hpp"
#include "tests/unit/scene/hand/rig.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

using testing::distance;
using testing::Hand;
using testing::Rig;

/// Numbers that a property may need.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : stream_{base::Seed{seed}.stream("hip")} {}
    double between(double low, double high)
    {
        return low + (high - low) * stream_.uniform(index_++);
    }
    glm::dvec3 vector(double most)
    {
        const double x = between(-most, most);
        const double y = between(-most, most);
        return {x, y, between(-most, most)};
    }

private:
    base::RandomStream stream_;
    std::uint64_t index_ = 0;
};

/// A box with up to four hands about it, anywhere, at any stiffness that is allowed.
Rig random_rig(Draw& draw)
{
    Rig rig;
    rig.mass = draw.between(0.01, 1.0);
    if (draw.between(0.0, 1.0) < 0.5) rig.half = {0.02, draw.between(0.01, 0.05), 0.015};
    rig.body.orientation = rotation_by(draw.vector(2.0));
    rig.body.velocity = draw.vector(0.5);
    rig.body.angular_momentum = box_inertia(rig.mass, rig.half) * draw.vector(10.0);
    const int hands = static_cast<int>(draw.between(1.0, 4.999));
    double size = 1e3;
    for (double decade = draw.between(0.0, 5.0); decade > 1.0; --decade) size *= 10.0;
    for (int i = 0; i < hands; ++i) {
        Hand hand;
        hand.position = draw.vector(0.04);
        hand.velocity = draw.vector(0.3);
        hand.stiffness = size * draw.between(1.0, 10.0);
        hand.damping = hand.stiffness * draw.between(0.0, 0.004);
        if (draw.between(0.0, 1.0) < 0.5) hand.force_max = draw.between(0.5, 10.0);
        rig.hands.push_back(hand);
    }
    return rig;
}

TEST(AdvanceProperty, MomentumChangesByTheImpulsesOfTheHandsAndTheOtherForces)
{
    Draw draw{1};
    for (int scene = 0; scene < 300; ++scene) {
        Rig rig = random_rig(draw);
        rig.acceleration = draw.vector(10.0);
        for (int i = 0; i < 10; ++i) {
            const glm::dvec3 before = rig.body.velocity;
            rig.tick(1e-3);
            glm::dvec3 impulse{0.0};
            for (std::size_t hand = 0; hand < rig.hands.size(); ++hand)
                impulse += rig.work[hand].impulse;
            const glm::dvec3 gained = 1e-3 * rig.acceleration + impulse / rig.mass;
            const double size = 1.0 + std::sqrt(glm::dot(gained, gained));
            ASSERT_LE(distance(rig.body.velocity, before + gained), 1e-12 * size) << scene;
        }
    }
}

TEST(AdvanceProperty, WhateverTheHandsDoTheBodyStaysFiniteAndItsOrientationUnit)
{
    Draw draw{2};
    for (int scene = 0; scene < 300; ++scene) {
        Rig rig = random_rig(draw);
        for (int i = 0; i < 20; ++i) {
            for (Hand& hand : rig.hands) {
                if (draw.between(0.0, 1.0) < 0.1) hand.position += draw.vector(0.02);
            }
            rig.tick(1e-3);
            ASSERT_TRUE(base::is_finite(rig.body.position)) << scene;
            ASSERT_TRUE(base::is_finite(rig.body.velocity)) << scene;
            ASSERT_TRUE(base::is_finite(rig.body.angular_momentum)) << scene;
            const glm::dquat& q = rig.body.orientation;
            ASSERT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-14) << scene;
        }
    }
}

TEST(AdvanceProperty, HandsAtRestWithDampersNeverAddEnergy)
{
    Draw draw{3};
    for (int scene = 0; scene < 300; ++scene) {
        Rig rig;
        rig.body.velocity = {draw.between(0.05, 0.3), 0.0, 0.0};
        Hand hand;
        hand.position = {0.0255, draw.between(-0.015, 0.015), draw.between(-0.015, 0.015)};
        hand.stiffness = draw.between(1e3, 1e5);
        hand.damping = draw.between(0.1, 5.0);
        rig.hands.push_back(hand);
        double before = rig.energy();
        const double start = before;
        for (int i = 0; i < 20; ++i) {
            rig.tick(1e-3);
            const double now = rig.energy();
            ASSERT_LE(now, before + 1e-5 * start) << scene << ' ' << i;
            before = now;
        }
        ASSERT_LT(before, start) << scene;
    }
}

} // namespace
} // namespace hapnet::scene
