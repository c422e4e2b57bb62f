// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/bodies.hpp"
#include "scene/maths/rotation.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

glm::dvec3 angular_velocity(const glm::dquat& orientation, const FreeRotation& free)
{
    const glm::dmat3 axes = axes_of(orientation);
    return axes * (free.inverse_inertia * (free.angular_momentum * axes));
}

/// The orientation one tick later by the Runge-Kutta method of Munthe-Kaas (BIT 38, 1998): fourth
/// order, so much finer than the rule under test that it stands for the truth.
glm::dquat reference_rotation(const glm::dquat& orientation, const FreeRotation& free, double tick)
{
    // The inverse of the exponential's derivative, up to the third order.
    const auto rate = [&](const glm::dvec3& angle) {
        const glm::dvec3 velocity = angular_velocity(rotation_by(angle) * orientation, free);
        const glm::dvec3 once = glm::cross(angle, velocity);
        return velocity - 0.5 * once + (1.0 / 12.0) * glm::cross(angle, once);
    };
    const glm::dvec3 k1 = angular_velocity(orientation, free);
    const glm::dvec3 k2 = rate(0.5 * tick * k1);
    const glm::dvec3 k3 = rate(0.5 * tick * k2);
    const glm::dvec3 k4 = rate(tick * k3);
    return rotated(orientation, (tick / 6.0) * (k1 + 2.0 * (k2 + k3) + k4));
}

double angle_between(const glm::dquat& a, const glm::dquat& b)
{
    const glm::dquat by = glm::conjugate(a) * b;
    return 2.0 * std::sqrt(by.x * by.x + by.y * by.y + by.z * by.z);
}

/// A box thrown with a spin about its middle axis, which flips again and again (Dzhanibekov).
FreeRotation flipping()
{
    const glm::dvec3 inertia = box_inertia(0.1, {0.01, 0.02, 0.03});
    return {inertia * glm::dvec3{0.01, 10.0, 0.01}, 1.0 / inertia};
}

template <typename Rule>
glm::dquat after_2_seconds(Rule rule, double tick)
{
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    const auto ticks = std::lround(2.0 / tick);
    for (long i = 0; i < ticks; ++i) orientation = rule(orientation, flipping(), tick);
    return orientation;
}

double energy(const glm::dquat& orientation)
{
    const FreeRotation spin = flipping();
    const glm::dvec3 momentum = spin.angular_momentum * axes_of(orientation);
    const glm::dvec3 velocity = spin.inverse_inertia * momentum;
    return 0.5 * (momentum.x * velocity.x + momentum.y * velocity.y + momentum.z * velocity.z);
}

TEST(Rotation, OfABoxThatFlipsIsOfSecondOrderAndWithin5e_4RadiansAfter2Seconds)
{
    const glm::dquat truth = after_2_seconds(reference_rotation, 1e-4);
    const double coarse = angle_between(after_2_seconds(rotated_freely, 2e-3), truth);
    const double fine = angle_between(after_2_seconds(rotated_freely, 1e-3), truth);
    EXPECT_LE(fine, 5e-5);
    EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(Rotation, TheReferenceIsOfFourthOrderAndWithin1e_9Radians)
{
    const glm::dquat truth = after_2_seconds(reference_rotation, 1e-4);
    const double coarse = angle_between(after_2_seconds(reference_rotation, 2e-3), truth);
    const double fine = angle_between(after_2_seconds(reference_rotation, 1e-3), truth);
    EXPECT_LE(fine, 1e-9);
    EXPECT_NEAR(coarse / fine, 16.0, 1.0);
}

TEST(Rotation, OfABoxThatFlipsKeepsItsEnergy)
{
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    glm::dquat finer = orientation;
    const double before = energy(orientation);
    for (int i = 0; i < 2000; ++i) {
        orientation = rotated_freely(orientation, flipping(), 1e-3);
        finer = reference_rotation(finer, flipping(), 1e-3);
    }
    EXPECT_NEAR(energy(orientation) / before, 1.0, 1e-9);
    EXPECT_NEAR(energy(finer) / before, 1.0, 1e-10);
}

TEST(Rotation, ATurnIsExactForSmallAndLargeAngles)
{
    for (const double angle : {1e-9, 1e-3, 0.5, 1.5, 1.6, 3.0, 100.0, 1000.0}) {
        const glm::dquat turn = rotation_by({0.0, angle, 0.0});
        EXPECT_NEAR(turn.w, std::cos(0.5 * angle), 1e-15) << angle;
        EXPECT_NEAR(turn.y, std::sin(0.5 * angle), 1e-15) << angle;
    }
}

TEST(Rotation, TheShortSeriesHoldUpToTheirLimit)
{
    for (int i = 0; i <= 100; ++i) {
        const double z = small_half_angle_max * i / 100.0;
        const HalfAngle turn = small_half_angle(z);
        EXPECT_NEAR(turn.cosine, std::cos(std::sqrt(z)), 3e-16) << z;
        EXPECT_NEAR(turn.sinc * std::sqrt(z), std::sin(std::sqrt(z)), 3e-16) << z;
    }
}

TEST(Rotation, BeyondAllSenseNothingTurnsAndNothingBreaks)
{
    const glm::dquat still = rotated({1.0, 0.0, 0.0, 0.0}, {1e200, 0.0, 0.0});
    EXPECT_EQ(still, (glm::dquat{1.0, 0.0, 0.0, 0.0}));
}

TEST(Rotation, TheTurnBetweenTwoOrientationsLeadsFromOneToTheOther)
{
    const glm::dquat from = base::normalized({0.3, -0.5, 0.7, 0.2});
    for (const double angle : {0.0, 1e-9, 0.1, 1.0, 3.0, 3.14159}) {
        const glm::dvec3 turn = angle * glm::dvec3{0.36, -0.48, 0.8};
        const glm::dvec3 found = turn_between(from, rotated(from, turn));
        EXPECT_NEAR(glm::distance(found, turn), 0.0, 1e-10) << angle;
    }
    // The shorter of the two rotations.
    const glm::dvec3 back = turn_between(from, rotated(from, {0.0, 4.0, 0.0}));
    EXPECT_NEAR(back.y, 4.0 - 2.0 * 3.14159265358979, 1e-10);
}

TEST(Rotation, AxesAreThoseOfTheQuaternion)
{
    const glm::dquat orientation = base::normalized({0.3, -0.5, 0.7, 0.2});
    const glm::dmat3 axes = axes_of(orientation);
    const glm::dmat3 expected = glm::mat3_cast(orientation);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            EXPECT_NEAR(axes[column][row], expected[column][row], 1e-15);
    }
}

} // namespace
} // namespace hapnet::scene
