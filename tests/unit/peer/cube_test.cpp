// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/cube.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

const Scene scene = paper_scene();
constexpr double stop_x = 0.0747;

base::Force push(double x, double y = 0.0, double z = 0.0) { return {{x, y, z}}; }

void step(Cube& cube, base::Force force, int ticks)
{
    for (int i = 0; i < ticks; ++i) cube.step(force);
}

TEST(Cube, StaysWhereItIsWhenNothingPushesIt)
{
    Cube cube{scene, 1ms};
    step(cube, {}, 10'000);
    EXPECT_EQ(cube.position(), base::Position{});
    EXPECT_EQ(cube.velocity(), base::Velocity{});
}

TEST(Cube, SlowsDownExactlyAsViscousFrictionSays)
{
    Cube cube{scene, 1ms};
    cube.place({}, {{0.3, 0.0, -0.1}});
    for (int ms = 1; ms <= 100; ++ms) {
        cube.step({});
        const double kept = std::exp(-scene.drag_ns_per_m * 1e-3 * ms / scene.cube_mass_kg);
        EXPECT_NEAR(cube.velocity().x(), 0.3 * kept, 1e-14) << ms;
        EXPECT_NEAR(cube.velocity().z(), -0.1 * kept, 1e-14) << ms;
    }
}

TEST(Cube, GainsSpeedExactlyAsAConstantForceUnderViscousFrictionSays)
{
    Cube cube{scene, 1ms};
    cube.place({{-1.0, 0.0, 0.0}}, {});
    for (int ms = 1; ms <= 100; ++ms) {
        cube.step(push(2.0));
        const double lacking = std::exp(-scene.drag_ns_per_m * 1e-3 * ms / scene.cube_mass_kg);
        EXPECT_NEAR(cube.velocity().x(), 0.2 * (1.0 - lacking), 1e-14) << ms;
    }
}

TEST(Cube, EndsAtTheForceOverTheFriction)
{
    Cube cube{scene, 1ms};
    cube.place({{-10.0, 0.0, 0.0}}, {});
    step(cube, push(3.3), 1000);
    EXPECT_NEAR(cube.velocity().x(), 0.33, 1e-15);
    const base::Position before = cube.position();
    cube.step(push(3.3));
    EXPECT_NEAR((cube.position() - before).x(), 0.33e-3, 1e-15);
}

TEST(Cube, WithoutFrictionKeepsItsSpeed)
{
    Scene ice = scene;
    ice.drag_ns_per_m = 0.0;
    Cube cube{ice, 1ms};
    step(cube, push(-1.0), 100);
    EXPECT_NEAR(cube.velocity().x(), -1.0, 1e-12); // 10 m/s^2 for 0.1 s
    step(cube, {}, 100);
    EXPECT_NEAR(cube.velocity().x(), -1.0, 1e-12);
}

TEST(Cube, StopsDeadAtTheStaticCube)
{
    Cube cube{scene, 1ms};
    step(cube, push(3.3), 1000);
    EXPECT_NEAR(cube.position().x(), stop_x, 1e-15);
    EXPECT_EQ(cube.velocity().x(), 0.0);
    step(cube, push(-1.0), 1);
    EXPECT_LT(cube.position().x(), stop_x); // and leaves it freely
}

TEST(Cube, SlidesAlongTheStaticCube)
{
    Cube cube{scene, 1ms};
    step(cube, push(3.3, 0.0, -1.0), 1000);
    EXPECT_NEAR(cube.position().z(), -0.1, 0.002); // 0.1 m/s for a second, less the start
    EXPECT_GT(cube.position().x(), stop_x);        // past its corner by now
}

TEST(Cube, StopsAtTheFaceOfTheStaticCubeThatItComesTo)
{
    Cube cube{scene, 1ms};
    cube.place({{0.1147, 0.0, -0.1}}, {}); // behind it
    step(cube, push(0.0, 0.0, 1.0), 3000);
    EXPECT_NEAR(cube.position().z(), 0.030 - 0.040, 1e-15);
    EXPECT_EQ(cube.position().x(), 0.1147);
}

TEST(Cube, PlacedAHairInsideTheStaticCubeDoesNotPassThroughIt)
{
    Cube cube{scene, 1ms};
    cube.place({{stop_x + 1e-8, 0.0, 0.0}}, {}); // as a rounding on the wire may leave it
    step(cube, push(3.3), 1000);
    EXPECT_NEAR(cube.position().x(), stop_x, 1e-15);
}

TEST(Cube, FallsBackOntoThePlatformAndStaysThere)
{
    Cube cube{scene, 1ms};
    cube.place({{0.0, 0.1, 0.0}}, {{0.2, 0.0, 0.0}});
    step(cube, {}, 100);
    EXPECT_NEAR(cube.position().y(), 0.1 - 0.5 * 9.81 * 0.01, 0.0006); // first order in 1 ms
    EXPECT_EQ(cube.velocity().x(), 0.2);                               // no friction in the air
    step(cube, {}, 200);
    EXPECT_EQ(cube.position().y(), 0.0);
    EXPECT_EQ(cube.velocity().y(), 0.0);
    step(cube, push(0.0, -5.0, 0.0), 100);
    EXPECT_EQ(cube.position().y(), 0.0);
}

TEST(Cube, IsLiftedByMoreThanItsWeightOnly)
{
    Cube cube{scene, 1ms};
    step(cube, push(0.0, 0.98, 0.0), 100); // 0.981 N
    EXPECT_EQ(cube.position().y(), 0.0);
    step(cube, push(0.0, 1.2, 0.0), 100);
    EXPECT_GT(cube.position().y(), 0.005);
}

TEST(Scene, HasAHashThatChangesWithEveryNumberOfIt)
{
    const std::uint64_t known = hash(scene);
    EXPECT_EQ(known, 0x2ad1943de23891b5U); // on every machine
    const auto differs = [&](auto change) {
        Scene other = scene;
        change(other);
        return hash(other) != known;
    };
    EXPECT_TRUE(differs([](Scene& s) { s.cube.centre.value.z = 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.cube.half.y += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.static_cube.centre.value.x += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.static_cube.half.z += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.cube_mass_kg += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.drag_ns_per_m += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.gravity_m_per_s2 += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.hip_radius_m += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.stiffness_n_per_m += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.damping_ns_per_m += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.force_max_n += 1e-9; }));
    EXPECT_TRUE(differs([](Scene& s) { s.grip_reach_m += 1e-9; }));
    EXPECT_FALSE(differs([](Scene& s) { s.cube.centre.value.x = -0.0; }));
}

TEST(PaperScene, HasEnoughFrictionForSoftnessToGrowWithDelay)
{
    EXPECT_GE(scene.drag_ns_per_m,
              std::sqrt(2.0 * scene.stiffness_n_per_m * scene.cube_mass_kg) * (1.0 - 1e-12));
}

} // namespace
} // namespace hapnet::peer
