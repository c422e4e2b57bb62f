// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Random scenes along one axis, against an integration in steps a hundred times as small.
#include "proto/base/random.hpp"
#include "tests/property/scene/one_box/reference.hpp"
#include "tests/unit/scene/one_box/rig.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene::reference_test {
namespace {

constexpr double tick = 1e-3;

struct Chance {
    base::RandomStream stream;
    std::uint64_t drawn = 0;

    double between(double low, double high) { return low + (high - low) * stream.uniform(drawn++); }
};

/// Two hands that come from both sides at different speeds; the left one leaves again.
Reference by_chance(Chance& chance)
{
    Reference scene;
    scene.drag = chance.between(0.0, 1.0) < 0.5 ? 0.0 : chance.between(0.1, 20.0);
    scene.damping = chance.between(0.0, 1.0) < 0.3 ? 0.0 : chance.between(0.1, 8.0);
    scene.stiffness = 1e3 * chance.between(0.1, 3.0);
    if (chance.between(0.0, 1.0) < 0.5) scene.force_max = chance.between(0.2, 2.0);
    if (chance.between(0.0, 1.0) < 0.5) {
        scene.wall = chance.between(0.001, 0.004);
        scene.restitution = chance.between(0.3, 1.0);
    }
    scene.v = chance.between(-0.2, 0.2);
    scene.hands = {
        {-1.0, -scene.touching + chance.between(-0.004, 0.001), chance.between(-0.1, 0.2)},
        {1.0, scene.touching + chance.between(-0.001, 0.004), chance.between(-0.2, 0.1)}};
    return scene;
}

template <bool coulomb>
Rig<coulomb> rig_for(const Reference& reference)
{
    Description scene = cube_on_platform(0.0, reference.drag);
    scene.hands.stiffness_n_per_m = reference.stiffness;
    scene.hands.damping_ns_per_m = reference.damping;
    scene.hands.force_max_n = reference.force_max;
    const double friction = reference.friction / (0.1 * 9.81);
    scene.bodies[0].material = {friction, reference.restitution};
    scene.planes[0].material.friction = friction;
    if (reference.wall < 1.0) {
        BodyDescription wall{.name = "wall", .movable = false};
        wall.position = {{reference.wall + 0.04, 0.0, 0.0}};
        scene.bodies.push_back(wall);
    }
    Rig<coulomb> rig{scene, tick};
    rig.place({reference.x, 0.0, 0.0}, {reference.v, 0.0, 0.0});
    for (std::uint32_t i = 0; i < reference.hands.size(); ++i) {
        const auto& hand = reference.hands[i];
        rig.set_hand(i, {hand.centre, 0.0, 0.0}, {hand.speed, 0.0, 0.0});
    }
    return rig;
}

/// The greatest distance between the two over 40 ticks.
template <bool coulomb>
double disagreement(Reference reference)
{
    auto rig = rig_for<coulomb>(reference);
    double worst = 0.0;
    for (int i = 1; i <= 40; ++i) {
        rig.tick();
        for (std::uint32_t hand = 0; hand < reference.hands.size(); ++hand) {
            rig.state.hands[hand].position.value.x =
                reference.hands[hand].centre + reference.hands[hand].speed * tick * i;
        }
        reference.run(tick * i, 1e-5);
        worst = std::max(worst, std::abs(rig.position().x - reference.x));
    }
    return worst;
}

TEST(OneBoxReference, WithDragDampersLimitsAndWallsItIsWithin1e14MetresOfTheTruth)
{
    Chance chance{base::Seed{42}.stream("sliding/mixed")};
    for (int i = 0; i < 40; ++i) {
        const Reference scene = by_chance(chance);
        EXPECT_LE(disagreement<false>(scene), 1e-14) << i;
    }
}

TEST(OneBoxReference, SticksAndSlipsWhereTheTruthDoes)
{
    Chance chance{base::Seed{42}.stream("sliding/friction")};
    for (int i = 0; i < 40; ++i) {
        Reference scene = by_chance(chance);
        scene.wall = 1e9;
        scene.friction = chance.between(0.05, 1.0);
        EXPECT_LE(disagreement<true>(scene), 1e-14) << i;
    }
}

} // namespace
} // namespace hapnet::scene::reference_test
