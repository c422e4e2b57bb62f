// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/sphere_box.hpp"
#include "tests/property/scene/collide/boxes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene::sphere_box_test {
namespace {

constexpr std::uint64_t seeds = 300;

glm::dvec3 surface_near(const OrientedBox& box, const glm::dvec3& point)
{
    glm::dvec3 result = box.centre;
    for (const int k : {0, 1, 2}) {
        const double place = glm::dot(box.axes[k], point - box.centre);
        result += std::clamp(place, -box.half[k], box.half[k]) * box.axes[k];
    }
    return result;
}

TEST(SphereBox, OverlapsFromOutsideExactlyByTheRadiusLessTheDistance)
{
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        BoxesDrawn drawn{base::Seed{seed}.stream("outside")};
        const OrientedBox box = drawn.box(0.01, 100.0);
        const double radius = drawn.uniform(0.001, 0.1);
        const glm::dvec3 centre = box.centre + drawn.within_cube(0.3);
        const double gap = glm::distance(centre, surface_near(box, centre));
        ASSERT_NEAR(distance(box, centre), gap, 1e-15);
        SphereBoxMemory memory;
        const auto overlap = memory.find(box, centre, radius);
        ASSERT_EQ(overlap.has_value(), gap < radius) << seed;
        if (!overlap || gap < 1e-12) continue;
        ASSERT_NEAR(overlap->depth, radius - gap, 1e-15) << seed;
        ASSERT_LE(glm::distance(overlap->point + gap * overlap->normal, centre), 1e-14) << seed;
    }
}

// The depth is continuous over edges and corners, and where the centre enters.
TEST(SphereBox, ChangesItsDepthNoFasterThanTheSphereMovesOutside)
{
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        BoxesDrawn drawn{base::Seed{seed}.stream("continuous")};
        const OrientedBox box = drawn.box(0.01, 3.0);
        const double radius = 0.02;
        const glm::dvec3 from = box.centre + drawn.within_cube(0.05);
        const glm::dvec3 step = 1e-4 * drawn.direction();
        SphereBoxMemory memory;
        const auto depth = [&](const glm::dvec3& centre) {
            const auto overlap = memory.find(box, centre, radius, to_local(box, centre - step));
            return overlap ? overlap->depth : 0.0;
        };
        double last = depth(from);
        bool was_outside = distance(box, from) > 0.0;
        for (int k = 1; k < 20; ++k) {
            const glm::dvec3 centre = from + static_cast<double>(k) * step;
            const double now = depth(centre);
            const bool is_outside = distance(box, centre) > 0.0;
            if (is_outside && was_outside) {
                ASSERT_LE(std::abs(now - last), 1e-4 + 1e-15);
            }
            // Also over an edge or a corner the centre enters through one face.
            if (!is_outside && was_outside) {
                ASSERT_LE(std::abs(now - radius), 2e-4) << seed;
            }
            last = now;
            was_outside = is_outside;
        }
    }
}

TEST(SphereBox, GivesTheSameInAnyFrame)
{
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        BoxesDrawn drawn{base::Seed{seed}.stream("frame")};
        const OrientedBox box = drawn.box(0.01, 3.0);
        const OrientedBox plain{.half = box.half};
        SphereBoxMemory rotated;
        SphereBoxMemory straight;
        glm::dvec3 before = drawn.within_cube(0.05);
        for (int k = 0; k < 10; ++k) {
            const glm::dvec3 place = drawn.within_cube(0.03);
            const auto here = rotated.find(box, box.centre + box.axes * place, 0.005, before);
            const auto there = straight.find(plain, place, 0.005, before);
            ASSERT_EQ(here.has_value(), there.has_value()) << seed;
            before = place;
            if (!here) continue;
            ASSERT_NEAR(here->depth, there->depth, 1e-15) << seed;
            ASSERT_LE(glm::distance(here->normal, box.axes * there->normal), 1e-12) << seed;
        }
    }
}

} // namespace
} // namespace hapnet::scene::sphere_box_test
