// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Any valid description and hands: states stay finite, and the box outside of obstacles.
#include "proto/base/random.hpp"
#include "tests/unit/scene/one_box/rig.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

class Chance {
public:
    explicit Chance(std::uint64_t seed) : stream_{base::Seed{seed}.stream("sliding/chance")} {}

    double between(double low, double high)
    {
        return low + (high - low) * stream_.uniform(drawn_++);
    }
    bool once_in(double times) { return between(0.0, times) < 1.0; }
    /// Evenly over the powers of ten.
    double scale(double low, double high)
    {
        double value = low;
        for (double steps = between(0.0, 8.0); steps > 0.0; steps -= 1.0) {
            value *=
                1.0 + (std::sqrt(std::sqrt(std::sqrt(high / low))) - 1.0) * std::min(steps, 1.0);
        }
        return value;
    }
    glm::dvec3 vector(double size)
    {
        const double x = between(-size, size);
        const double y = between(-size, size);
        return {x, y, between(-size, size)};
    }
    Description scene()
    {
        const double friction = once_in(2) ? 0.0 : between(0.0, 1.0);
        const double drag = once_in(2) ? 0.0 : scale(0.01, 1e4);
        Description scene = cube_on_platform(friction, drag);
        scene.bodies[0].mass_kg = scale(1e-4, 1e2);
        scene.bodies[0].material.restitution = once_in(2) ? 0.0 : between(0.0, 1.0);
        scene.hands.stiffness_n_per_m = scale(1.0, 1e7);
        scene.hands.damping_ns_per_m = once_in(3) ? 0.0 : scale(0.01, 1e3);
        scene.hands.force_max_n = once_in(2) ? 1e9 : scale(0.1, 10.0);
        scene.hands.count = 4;
        for (int i = 0; i < 3; ++i) {
            BodyDescription fixed{.name = "fixed", .movable = false};
            fixed.position = {vector(0.08)};
            fixed.half = glm::dvec3{0.001} + glm::abs(vector(0.02));
            fixed.material.friction = 0.3;
            if (once_in(2)) scene.bodies.push_back(fixed);
        }
        return scene;
    }
    HandInput hand()
    {
        return {{vector(0.04)}, {vector(once_in(10) ? 100.0 : 0.3)}, !once_in(10), once_in(4)};
    }

private:
    base::RandomStream stream_;
    std::uint64_t drawn_ = 0;
};

bool overlaps(const Description& scene, const glm::dvec3& centre)
{
    constexpr double rounding = 1e-12;
    if (centre.y < -rounding) return true;
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        const auto& fixed = scene.bodies[i];
        const glm::dvec3 gap = glm::abs(centre - fixed.position.value) - fixed.half - 0.02;
        if (gap.x < -rounding && gap.y < -rounding && gap.z < -rounding) return true;
    }
    return false;
}

template <bool coulomb>
void live(std::uint64_t seed)
{
    Chance chance{seed};
    const Description scene = chance.scene();
    Rig<coulomb> rig{scene, chance.scale(1e-5, 1e-2)};
    rig.place({0.0, 0.2, 0.0}, chance.vector(1.0));
    for (int i = 0; i < 50; ++i) {
        for (std::uint32_t hand = 0; hand < 4; ++hand) {
            if (chance.once_in(10)) rig.state.hands[hand] = chance.hand();
        }
        const glm::dvec3 there = chance.vector(0.08);
        const glm::dvec3 so_fast = chance.vector(1.0);
        if (chance.once_in(30) && !overlaps(scene, there)) rig.place(there, so_fast);
        rig.carry(1);
        ASSERT_TRUE(base::is_finite(rig.position())) << seed << ' ' << i;
        ASSERT_TRUE(base::is_finite(rig.velocity())) << seed << ' ' << i;
        for (const HandTouch& touch : rig.state.touches) {
            ASSERT_TRUE(base::is_finite(touch.on_hand)) << seed << ' ' << i;
            ASSERT_LE(base::norm(touch.on_body), scene.hands.force_max_n * 1.0000001) << seed;
        }
        ASSERT_FALSE(overlaps(scene, rig.position())) << seed << ' ' << i;
    }
}

TEST(OneBoxByChance, ItStaysFiniteAndOutsideOfThings)
{
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        live<false>(seed);
        live<true>(seed);
        if (HasFatalFailure()) return;
    }
}

} // namespace
} // namespace hapnet::scene
