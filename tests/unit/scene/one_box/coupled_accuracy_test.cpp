// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Hands at edges and corners.
#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::scene::coupled_accuracy_test {
namespace {

constexpr double mass = 0.1;
constexpr double radius = 0.005;

/// The same physics by Runge and Kutta's fourth order, for springs that press throughout.
struct Reference {
    struct Spring {
        glm::dvec3 normal;
        double depth;
        glm::dvec3 velocity; // the hand's
    };
    double stiffness = 500.0;
    double damping = 0.0;
    double drag = 0.0;
    glm::dvec3 moves{1.0}; // 0 along an axis that is held
    std::vector<Spring> springs{};
    glm::dvec3 x{0.0};
    glm::dvec3 v{0.0};

    [[nodiscard]] glm::dvec3 acceleration(double time, const glm::dvec3& way,
                                          const glm::dvec3& speed) const
    {
        glm::dvec3 force = -drag * speed;
        for (const Spring& spring : springs) {
            const glm::dvec3& n = spring.normal;
            const double depth = spring.depth + glm::dot(n, way - time * spring.velocity);
            const double closing = glm::dot(n, speed - spring.velocity);
            force -= (stiffness * depth + damping * closing) * n;
        }
        return moves * force / mass;
    }
    void run(double tick)
    {
        constexpr int steps = 1000;
        const double h = tick / steps;
        for (int i = 0; i < steps; ++i) {
            const double t = h * i;
            const glm::dvec3 a1 = acceleration(t, x, v);
            const glm::dvec3 v2 = v + 0.5 * h * a1;
            const glm::dvec3 a2 = acceleration(t + 0.5 * h, x + 0.5 * h * v, v2);
            const glm::dvec3 v3 = v + 0.5 * h * a2;
            const glm::dvec3 a3 = acceleration(t + 0.5 * h, x + 0.5 * h * v2, v3);
            const glm::dvec3 v4 = v + h * a3;
            const glm::dvec3 a4 = acceleration(t + h, x + h * v3, v4);
            x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
            v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        }
    }
};

/// Sets a hand outside of the cube at the origin, in the stepper and in the reference.
template <bool coulomb>
void add_hand(Rig<coulomb>& rig, Reference& reference, std::uint32_t index, const glm::dvec3& place,
              const glm::dvec3& velocity)
{
    rig.set_hand(index, place, velocity);
    glm::dvec3 away{0.0};
    for (const int axis : {0, 1, 2}) {
        const double beyond = std::abs(place[axis]) - 0.02;
        if (beyond > 0.0) away[axis] = place[axis] < 0.0 ? -beyond : beyond;
    }
    const double distance = std::sqrt(glm::dot(away, away));
    reference.springs.push_back({away / distance, radius - distance, velocity});
}

void expect_agreement(const Rig<false>& rig, const Reference& reference)
{
    for (const int axis : {0, 1, 2}) {
        EXPECT_NEAR(rig.position()[axis], reference.x[axis], 1e-15) << axis;
        EXPECT_NEAR(rig.velocity()[axis], reference.v[axis], 1e-12) << axis;
    }
}

TEST(SlantedSprings, OfThreeHandsAndAFaceFollowTheTruth)
{
    Description scene = lone_cube();
    scene.hands.count = 4;
    scene.hands.stiffness_n_per_m = 1e5;
    scene.hands.damping_ns_per_m = 20.0;
    Rig<false> rig{scene};
    Reference reference{.stiffness = 1e5, .damping = 20.0};
    add_hand(rig, reference, 0, {-0.0215, -0.0221, 0.003}, {0.3, 0.25, 0.0});
    add_hand(rig, reference, 1, {0.0212, 0.0214, 0.0209}, {-0.2, -0.2, -0.1});
    add_hand(rig, reference, 2, {0.005, 0.0221, -0.0224}, {0.1, -0.2, 0.3});
    add_hand(rig, reference, 3, {0.0225, 0.001, 0.001}, {-0.3, 0.0, 0.0});
    rig.tick();
    reference.run(1e-3);
    expect_agreement(rig, reference);
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_TRUE(rig.touch(i).touching) << i;
}

TEST(SlantedSprings, FollowTheTruthAlongAPlaneThatDrags)
{
    Description scene = cube_on_platform(0.0, 30.0);
    scene.hands.stiffness_n_per_m = 2e5;
    scene.hands.damping_ns_per_m = 5.0;
    Rig<false> rig{scene};
    Reference reference{.stiffness = 2e5, .damping = 5.0, .drag = 30.0, .moves = {1.0, 0.0, 1.0}};
    add_hand(rig, reference, 0, {-0.0215, 0.0221, -0.0214}, {0.3, -0.1, 0.2});
    add_hand(rig, reference, 1, {0.0228, 0.0, 0.0231}, {-0.1, 0.0, 0.0});
    rig.tick();
    reference.run(1e-3);
    expect_agreement(rig, reference);
    EXPECT_EQ(rig.position().y, 0.0);
}

TEST(SlantedSprings, BounceInATickWithoutLosingAnything)
{
    for (const double stiffness : {1e6, 1e7, 1e8}) {
        Description scene = lone_cube();
        scene.hands.stiffness_n_per_m = stiffness;
        Rig<false> rig{scene, 4e-3};
        rig.place({0.0, 0.0, 0.0}, {1.0, 0.7, 0.2});
        rig.set_hand(0, {0.0249, 0.0238, 0.001}); // it comes to the edge within the tick
        rig.tick();
        // The normal is that of the start or end of the tick, and the push is along it.
        const glm::dvec3 push = rig.velocity() - glm::dvec3{1.0, 0.7, 0.2};
        EXPECT_LT(push.x, 0.0);
        EXPECT_NEAR(glm::dot(rig.velocity(), rig.velocity()), 1.53, 1e-11 * 1.53) << stiffness;
        EXPECT_NEAR(rig.touch(0).on_body.x() * 4e-3, mass * push.x, 1e-14);
        EXPECT_EQ(rig.velocity().z, 0.2);
    }
}

TEST(SlantedSprings, GiveNoMoreThanTheyHaveStoredWhenDryFrictionLetsGo)
{
    Description scene = cube_on_platform(0.5);
    scene.hands.stiffness_n_per_m = 1e7; // k dt^2 / m = 100
    Rig<true> rig{scene};
    rig.set_hand(0, {-0.0225, 0.0, -0.0231});
    const double depth = radius - std::sqrt(0.0025 * 0.0025 + 0.0031 * 0.0031);
    rig.tick();
    const double energy = 0.5 * mass * glm::dot(rig.velocity(), rig.velocity());
    EXPECT_GT(energy, 0.9 * 0.5 * 1e7 * depth * depth); // friction takes little of it
    EXPECT_LT(energy, 0.5 * 1e7 * depth * depth);
}

TEST(SlantedSprings, NeverPushWithMoreThanTheGreatestForce)
{
    Description scene = lone_cube();
    scene.hands.stiffness_n_per_m = 1e8;
    scene.hands.force_max_n = 2.0;
    Rig<false> rig{scene};
    rig.place({0.0, 0.0, 0.0}, {0.5, 0.5, 0.0});
    rig.set_hand(0, {0.0225, 0.0231, 0.0});
    rig.tick();
    EXPECT_NEAR(base::norm(rig.touch(0).on_body), 2.0, 1e-9);
    EXPECT_LE(base::norm(rig.touch(0).on_body), 2.0 * (1.0 + 1e-12));
}

} // namespace
} // namespace hapnet::scene::coupled_accuracy_test
