// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Bodies that overlap when a scene begins come apart within a number of ticks.
#include "scene/query.hpp"
#include "scene/world.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tuple>

namespace hapnet::test {
namespace {

using scene::BodyId;
using scene::Description;
using scene::World;

constexpr double half = 0.02; // of every cube here
constexpr double gone = 1e-4; // of that: overlaps below it count as resolved

/// 30 % of an overlap is removed in a tick, but at most a tenth of the half edge.
int ticks_for(double overlap)
{
    int ticks = 0;
    for (double left = overlap; left > gone; ++ticks) left -= std::min(0.3 * left, 0.1);
    return ticks;
}

/// The deepest overlap, in half edges; no cube of these scenes turns far.
double deepest(const World& world)
{
    double most = 0.0;
    const auto count = static_cast<BodyId>(world.state().bodies.size());
    for (BodyId a = 0; a < count; ++a) {
        for (const auto& plane : world.frozen().planes) {
            const glm::dvec3 up = glm::conjugate(world.body(a).orientation) * plane.normal;
            const double reach = half * (std::abs(up.x) + std::abs(up.y) + std::abs(up.z));
            most = std::max(most, reach - glm::dot(world.position(a).value, plane.normal));
        }
        for (BodyId b = 0; b < a; ++b) {
            const glm::dvec3 between = world.position(a).value - world.position(b).value;
            if (glm::length(between) >= 3.0 * half) continue;
            most = std::max(most, -scene::separation(world, a, b).distance);
        }
    }
    return most / half;
}

/// Cubes that overlap by a share of their half edges, `width` by `height` by `width` of them.
Description overlapping(double share, int width, int height)
{
    Description scene;
    scene.hands.count = 0;
    const double pitch = (2.0 - share) * half;
    for (int i = 0; i < width * height * width; ++i) {
        const int x = i % width, z = i / width % width, y = i / (width * width);
        scene::BodyDescription cube{.name = "cube", .half = glm::dvec3{half}};
        cube.material.friction = 0.3;
        cube.position = {{pitch * x, pitch * y + (1.0 - share) * half, pitch * z}};
        scene.bodies.push_back(cube);
    }
    return scene;
}

/// Returns the number of ticks until no overlap exceeds `least` half edges.
int ticks_until(World& world, double least, int most)
{
    for (int tick = 0; tick < most; ++tick) {
        if (deepest(world) <= least) return tick;
        world.tick();
    }
    return most;
}

class Overlaps : public testing::TestWithParam<double> {};

TEST_P(Overlaps, OfAStackOnTheFloorGoByTheFormula)
{
    for (const int height : {1, 2, 4}) {
        Description scene = overlapping(GetParam(), 1, height);
        scene.planes = {{.name = "floor"}};
        World world = World::freeze(scene).value();
        const int needed = ticks_for(deepest(world));
        EXPECT_GT(needed, 10);
        EXPECT_LE(ticks_until(world, gone, 2 * needed), needed) << height;
    }
}

/// A heap has more contacts than a tick has visits for. It takes longer, and weight that presses
/// bodies together leaves a little.
TEST_P(Overlaps, OfAHeapAreBelowOnePercentWithinAHundredAndFiftyTicks)
{
    constexpr double small = 0.01;
    constexpr int most = 150;
    for (const bool floats : {true, false}) {
        for (const int edge : {2, 3, 4}) {
            Description scene = overlapping(GetParam(), edge, edge);
            if (floats) {
                scene.gravity = glm::dvec3{0.0};
            } else {
                scene.planes = {{.name = "floor"}};
            }
            World world = World::freeze(scene).value();
            EXPECT_GT(deepest(world), small);
            EXPECT_LT(ticks_until(world, small, most), most) << edge << (floats ? " floats" : "");
            if (!floats) continue;
            for (BodyId id = 0; id < scene.bodies.size(); ++id) { // overlaps must not cause speed
                EXPECT_EQ(glm::length(world.velocity(id).value), 0.0);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(InHalfEdges, Overlaps, testing::Values(0.02, 0.1, 0.3, 0.6, 1.0));

} // namespace
} // namespace hapnet::test
