// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/cluster.hpp"

#include "proto/base/random.hpp"
#include "proto/base/space.hpp"
#include "scene/maths/rotation.hpp"
#include "tests/support/scene/dice.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene::cluster_test {
namespace {

/// Some bodies of any shape, place and motion, and the sums of their momenta.
struct Crowd {
    Description description;
    Bodies bodies;
    std::vector<ClusterPart> parts;

    explicit Crowd(Description described) : description{std::move(described)}, bodies{description}
    {
        for (Slot slot = 0; slot < bodies.movable; ++slot) {
            parts.push_back({bodies.properties[slot],
                             {bodies.position.at(slot), axes_of(bodies.orientation.at(slot)),
                              bodies.properties[slot].half},
                             bodies.velocity.at(slot),
                             bodies.angular_momentum.at(slot)});
        }
    }

    [[nodiscard]] Cluster stuck() const
    {
        Cluster cluster;
        for (const ClusterPart& part : parts) cluster.count(part);
        for (const ClusterPart& part : parts) cluster.join(part);
        cluster.stick();
        return cluster;
    }
    [[nodiscard]] double energy(const ClusterPart& part, const glm::dvec3& velocity,
                                const glm::dvec3& momentum) const
    {
        const Slot slot = bodies.slot_of[part.properties.id];
        return 0.5 * part.properties.mass * glm::dot(velocity, velocity) +
               0.5 * glm::dot(momentum, bodies.apply_inverse_inertia(slot, momentum));
    }
};

Description random_crowd(std::uint64_t seed)
{
    test::Dice dice{base::Seed{seed}.stream("crowd")};
    Description scene;
    for (int i = 0; i < 5; ++i) {
        BodyDescription body;
        body.half = {dice.between(0.01, 0.03), dice.between(0.01, 0.03), dice.between(0.01, 0.03)};
        body.mass_kg = dice.power(0.1, 10.0);
        body.position.value = 0.1 * dice.vector();
        body.orientation =
            base::normalized(glm::dquat{dice.sign(), dice.sign(), dice.sign(), dice.sign()});
        body.velocity.value = 10.0 * dice.vector();
        body.angular_velocity = 300.0 * dice.vector();
        scene.bodies.push_back(body);
    }
    return scene;
}

struct Sums {
    glm::dvec3 momentum{0.0};
    glm::dvec3 angular_momentum{0.0}; // about the origin
    double energy = 0.0;

    void add(const Crowd& crowd, const ClusterPart& part, const glm::dvec3& velocity,
             const glm::dvec3& spin_momentum)
    {
        momentum += part.properties.mass * velocity;
        angular_momentum +=
            spin_momentum + part.properties.mass * glm::cross(part.box.centre, velocity);
        energy += crowd.energy(part, velocity, spin_momentum);
    }
};

Sums before(const Crowd& crowd)
{
    Sums sums;
    for (const ClusterPart& part : crowd.parts)
        sums.add(crowd, part, part.velocity, part.angular_momentum);
    return sums;
}

Sums after(const Crowd& crowd, const Cluster& cluster)
{
    Sums sums;
    for (const ClusterPart& part : crowd.parts)
        sums.add(crowd, part, cluster.motion_of(part).velocity, cluster.angular_momentum_of(part));
    return sums;
}

TEST(Cluster, KeepsMomentumAndAngularMomentumAndLosesEnergy)
{
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Crowd crowd{random_crowd(seed)};
        const Sums then = before(crowd);
        const Sums now = after(crowd, crowd.stuck());
        EXPECT_LE(glm::length(now.momentum - then.momentum), 1e-12 * glm::length(then.momentum));
        EXPECT_LE(glm::length(now.angular_momentum - then.angular_momentum),
                  1e-11 * glm::length(then.angular_momentum));
        EXPECT_LT(now.energy, then.energy);
    }
}

TEST(Cluster, MovesAsOneRigidBody)
{
    const Crowd crowd{random_crowd(3)};
    const Cluster cluster = crowd.stuck();
    const BodyMotion first = cluster.motion_of(crowd.parts[0]);
    EXPECT_GT(glm::length(first.spin), 0.1);
    for (const ClusterPart& part : crowd.parts) {
        const BodyMotion its = cluster.motion_of(part);
        EXPECT_EQ(its.spin, first.spin);
        const glm::dvec3 apart = part.box.centre - crowd.parts[0].box.centre;
        EXPECT_NEAR(glm::dot(its.velocity - first.velocity, apart), 0.0, 1e-14);
        const Slot slot = crowd.bodies.slot_of[part.properties.id];
        const glm::dvec3 spin =
            crowd.bodies.apply_inverse_inertia(slot, cluster.angular_momentum_of(part));
        EXPECT_LE(glm::length(spin - its.spin), 1e-12 * glm::length(its.spin));
    }
}

TEST(Cluster, ThatMovedAsOneRigidBodyLosesNothing)
{
    Description scene = random_crowd(5);
    const glm::dvec3 velocity{1.0, -2.0, 3.0};
    const glm::dvec3 spin{4.0, 5.0, -6.0};
    for (BodyDescription& body : scene.bodies) {
        body.velocity.value = velocity + glm::cross(spin, body.position.value);
        body.angular_velocity = spin;
    }
    const Crowd crowd{scene};
    EXPECT_NEAR(after(crowd, crowd.stuck()).energy, before(crowd).energy,
                1e-12 * before(crowd).energy);
}

TEST(Cluster, KeepsTheLocksOfItsParts)
{
    Description scene = random_crowd(7);
    scene.bodies[1].locked.y = true;
    Crowd crowd{scene};
    Cluster cluster = crowd.stuck();
    for (const ClusterPart& part : crowd.parts) {
        EXPECT_EQ(cluster.motion_of(part).velocity, cluster.velocity());
        EXPECT_EQ(cluster.velocity().y, 0.0);
        EXPECT_EQ(cluster.motion_of(part).spin, glm::dvec3{0.0});
    }
    EXPECT_NEAR(after(crowd, cluster).momentum.x, before(crowd).momentum.x, 1e-12);
    // A wall that moves along the locked axis moves nothing.
    EXPECT_EQ(cluster.stick_to_wall({0.0, 1.0, 0.0}, {0.0, 50.0, 0.0}), glm::dvec3{0.0});

    scene = random_crowd(7);
    scene.bodies[2].turning = Turning::about_z;
    scene.bodies[2].orientation = {1.0, 0.0, 0.0, 0.0};
    crowd = Crowd{scene};
    cluster = crowd.stuck();
    const glm::dvec3 spin = cluster.motion_of(crowd.parts[0]).spin;
    EXPECT_EQ(spin.x, 0.0);
    EXPECT_EQ(spin.y, 0.0);
    EXPECT_NE(spin.z, 0.0);
    EXPECT_LT(after(crowd, cluster).energy, before(crowd).energy);
}

TEST(Cluster, LosesAtWallsWhatItHasAgainstThem)
{
    Description scene = random_crowd(9);
    for (BodyDescription& body : scene.bodies) body.velocity.value = {-3.0, -2.0, 1.0};
    const Crowd crowd{scene};
    Cluster cluster = crowd.stuck();
    const auto is_now = [&](const glm::dvec3& velocity) {
        EXPECT_LE(glm::length(cluster.velocity() - velocity), 1e-14);
    };
    EXPECT_EQ(cluster.stick_to_wall({1.0, 0.0, 0.0}, glm::dvec3{0.0}).y, 0.0);
    is_now({0.0, -2.0, 1.0});
    const glm::dvec3 change = cluster.stick_to_wall({0.0, 1.0, 0.0}, glm::dvec3{0.0});
    EXPECT_LE(glm::length(change - glm::dvec3{0.0, 2.0, 0.0}), 1e-14);
    is_now({0.0, 0.0, 1.0});
    cluster.stick_to_wall({0.0, 0.0, -1.0}, glm::dvec3{0.0});
    is_now({0.0, 0.0, 0.0});
    // A moving wall takes it along.
    cluster = crowd.stuck();
    cluster.stick_to_wall({0.0, 1.0, 0.0}, {0.0, 5.0, 0.0});
    is_now({-3.0, 5.0, 1.0});
}

} // namespace
} // namespace hapnet::scene::cluster_test
