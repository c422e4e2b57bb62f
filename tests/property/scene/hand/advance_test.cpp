// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"
#include "proto/base/space.hpp"
#include "tests/unit/scene/hand/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

namespace hapnet::scene {
namespace {

using testing::distance;
using testing::Hand;
using testing::Rig;

/// Draws numbers for a property.
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

/// A box with up to four hands around it, anywhere, with any allowed stiffness.
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

/// Up to eight hands, some of which hold, of any stiffness and speed. Some bodies have drag.
struct HostileRig {
    explicit HostileRig(Draw& draw) : rig{random_rig(draw)}
    {
        const double fast = draw.between(0.0, 1.0) < 0.3 ? 20.0 : 1.0;
        rig.body.velocity *= fast;
        rig.body.angular_momentum *= fast;
        rig.acceleration = draw.vector(50.0);
        while (rig.hands.size() < 8 && draw.between(0.0, 1.0) < 0.5) {
            Hand hand = rig.hands.front();
            hand.position = draw.vector(0.03);
            hand.velocity = draw.vector(0.3);
            rig.hands.push_back(hand);
        }
        dynamics = rig.dynamics();
        if (draw.between(0.0, 1.0) < 0.3) {
            dynamics.drag = std::pow(10.0, draw.between(-1.0, 5.0));
            dynamics.drag_normal = {0.0, 1.0, 0.0};
        }
        for (const Hand& hand : rig.hands) {
            springs.push_back(rig.touch(rig.body, hand));
            springs.back().holds = draw.between(0.0, 1.0) < 0.2;
            springs.back().stretch = draw.vector(0.005);
        }
    }

    [[nodiscard]] double kinetic_energy(const MovingBody& body) const
    {
        return 0.5 * rig.mass * glm::dot(body.velocity, body.velocity) +
               0.5 * glm::dot(body.angular_momentum,
                              dynamics.inverse_inertia * body.angular_momentum);
    }

    Rig rig;
    BodyDynamics dynamics;
    std::vector<HandSpring> springs;
};

/// The uncertain energy of a rotating box with the inertia of the start: see SceneLaws.
double vague_energy(const HostileRig& hostile, const MovingBody& before, const MovingBody& after)
{
    if (hostile.dynamics.rotates_uniformly) return 0.0;
    const glm::dvec3 inertia = box_inertia(hostile.rig.mass, hostile.rig.half);
    const double least = std::min({inertia.x, inertia.y, inertia.z});
    const double most = std::max({inertia.x, inertia.y, inertia.z});
    const auto size = [](const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); };
    const glm::dmat3& light = hostile.dynamics.inverse_inertia;
    const double spin =
        std::max(size(light * before.angular_momentum), size(light * after.angular_momentum));
    const double angle = 1e-3 * spin;
    double vague = (most / least - 1.0) * angle * spin *
                   size(after.angular_momentum - before.angular_momentum);
    if (angle > 0.25) {
        vague += 0.5 * (1.0 / least - 1.0 / most) *
                 (glm::dot(before.angular_momentum, before.angular_momentum) +
                  glm::dot(after.angular_momentum, after.angular_momentum));
    }
    return vague;
}

/// Speed of the fastest corner, at the start or at the end.
double fastest_corner(const HostileRig& hostile, const MovingBody& before, const MovingBody& after)
{
    const auto size = [](const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); };
    const auto speed = [&](const MovingBody& body) {
        return size(body.velocity) +
               size(hostile.rig.half) *
                   size(hostile.dynamics.inverse_inertia * body.angular_momentum);
    };
    return std::max(speed(before), speed(after));
}

TEST(AdvanceProperty, HandsGiveWhatTheirSpringsStoredAndTheirMotionDidAndNoMore)
{
    Draw draw{4};
    int braked = 0;
    for (int scene = 0; scene < 3000; ++scene) {
        HostileRig hostile{draw};
        MovingBody& body = hostile.rig.body;
        const MovingBody before = body;
        PressedModes modes;
        const HandEnergy given =
            advance(body, hostile.dynamics, hostile.springs, hostile.rig.work, 1e-3, modes);
        if (given.is_braked) ++braked;
        const double start = hostile.kinetic_energy(before);
        const double end = hostile.kinetic_energy(body);
        const glm::dvec3 force = hostile.rig.mass * hostile.rig.acceleration;
        const double work = std::max(glm::dot(force, 0.5e-3 * (before.velocity + body.velocity)),
                                     glm::dot(force, body.position - before.position));
        const double there = start + end + std::abs(work);
        const double gripped = given.grips.given(1.0, fastest_corner(hostile, before, body));
        ASSERT_LE(end - start, work + given.stored + given.driven + gripped +
                                   vague_energy(hostile, before, body) + 1e-6 * there)
            << scene;
    }
    EXPECT_GT(braked, 0);
    EXPECT_LT(braked, 300);
}

TEST(AdvanceProperty, NoHandGivesMoreThanItsGreatestForceInATick)
{
    Draw draw{5};
    for (int scene = 0; scene < 3000; ++scene) {
        HostileRig hostile{draw};
        PressedModes modes;
        std::ignore = advance(hostile.rig.body, hostile.dynamics, hostile.springs, hostile.rig.work,
                              1e-3, modes);
        for (std::size_t i = 0; i < hostile.springs.size(); ++i) {
            const glm::dvec3& impulse = hostile.rig.work[i].impulse;
            ASSERT_LE(std::sqrt(glm::dot(impulse, impulse)),
                      1e-3 * hostile.springs[i].force_max * (1.0 + 1e-8))
                << scene << ' ' << i;
        }
    }
}

TEST(AdvanceProperty, AmongStiffHandsAtRestABodyKeepsItsEnergyOrLosesIt)
{
    Draw draw{6};
    for (int scene = 0; scene < 60; ++scene) {
        Rig rig;
        if (scene % 2 == 1) rig.half = {0.02, 0.03, 0.015};
        rig.body.velocity = draw.vector(1.0);
        rig.body.angular_momentum = box_inertia(rig.mass, rig.half) * draw.vector(10.0);
        const double stiffness = std::pow(10.0, draw.between(5.0, 8.0));
        const std::size_t hands = 1 + static_cast<std::size_t>(scene) % 8;
        for (std::size_t i = 0; i < hands; ++i) {
            glm::dvec3 at = 0.7 * rig.half * draw.vector(1.0);
            const int axis = static_cast<int>(i % 3);
            at[axis] = (i / 3 % 2 == 1 ? -1.0 : 1.0) * (rig.half[axis] + 0.0052);
            rig.hands.push_back({.position = at, .stiffness = stiffness});
        }
        const double start = rig.energy();
        for (int i = 0; i < 300; ++i) {
            rig.tick(1e-3);
            ASSERT_LE(rig.energy(), 1.03 * start) << scene << ' ' << i;
        }
    }
}

} // namespace
} // namespace hapnet::scene
