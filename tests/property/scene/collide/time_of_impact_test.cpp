// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/advancement.hpp"
#include "tests/property/scene/collide/boxes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene::time_of_impact_test {
namespace {

constexpr std::uint64_t pairs = 200;

struct Flight {
    OrientedBox a;
    OrientedBox b;
    glm::dvec3 velocity{0.0};

    [[nodiscard]] OrientedBox b_at(long double time) const
    {
        // Rounded to double, which is the finest resolution of the answer.
        OrientedBox box = b;
        for (const int k : {0, 1, 2})
            box.centre[k] = static_cast<double>(b.centre[k] + time * velocity[k]);
        return box;
    }

    [[nodiscard]] long double separation_at(long double time) const
    {
        return Exhaustive::separation(a, b_at(time));
    }
};

/// Flies at a point near the other body, a second away at most.
Flight draw(std::uint64_t seed)
{
    BoxesDrawn drawn{base::Seed{seed}.stream("flight")};
    Flight flight{.a = drawn.box(1.0, 10.0), .b = drawn.box(seed % 2 == 0 ? 1.0 : 0.1, 10.0)};
    flight.b.centre = flight.a.centre + 40.0 * drawn.direction();
    if (drawn.one_in(4)) flight.b.axes = flight.a.axes;
    const glm::dvec3 target = flight.a.centre + drawn.within_cube(8.0);
    flight.velocity = (target - flight.b.centre) * drawn.uniform(1.0, 20.0);
    return flight;
}

/// Finds the time at which the separation becomes negative, between two given times.
long double bisected(const Flight& flight, long double apart, long double overlapping)
{
    for (int k = 0; k < 60; ++k) {
        const long double centre = 0.5L * (apart + overlapping);
        (flight.separation_at(centre) > 0.0L ? apart : overlapping) = centre;
    }
    return 0.5L * (apart + overlapping);
}

TEST(FirstTouch, IsWhereBisectionFindsIt)
{
    std::uint64_t touched = 0;
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        const Flight flight = draw(seed);
        const auto impact = time_of_impact(flight.a, flight.b, flight.velocity, 2.0);
        if (!impact) continue;
        ++touched;
        const long double deeper = impact->time * (1.0L + 1e-6L);
        if (flight.separation_at(deeper) >= 0.0L) continue; // only grazes
        const auto time = static_cast<double>(bisected(flight, 0.0L, deeper));
        ASSERT_NEAR(impact->time, time, 1e-12 * time) << seed;
        ASSERT_LT(glm::dot(impact->normal, flight.velocity), 0.0) << seed;
        ASSERT_NEAR(glm::dot(impact->normal, impact->normal), 1.0, 1e-12) << seed;
        // At that moment no gap is left along the normal.
        const auto gap = static_cast<double>(Exhaustive::along(flight.a, flight.b_at(impact->time),
                                                               Exhaustive::vector(impact->normal)));
        ASSERT_NEAR(gap, 0.0, 1e-11) << seed;
    }
    EXPECT_GT(touched, pairs / 4);
}

TEST(FirstTouch, IsNotMissed)
{
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        const Flight flight = draw(seed);
        if (time_of_impact(flight.a, flight.b, flight.velocity, 2.0)) continue;
        for (int k = 0; k <= 50; ++k) ASSERT_GE(flight.separation_at(0.04L * k), -1e-12L) << seed;
    }
}

/// Two boxes that fly and spin steadily toward each other, for a second.
struct Spinners {
    SteadyBox a;
    SteadyBox b;

    [[nodiscard]] double gap_at(double time) const
    {
        return gap_between(a.at(time), b.at(time)).distance;
    }
};

Spinners draw_spinners(std::uint64_t seed)
{
    const Flight flight = draw(seed);
    BoxesDrawn drawn{base::Seed{seed}.stream("spin")};
    const auto steady = [&](const OrientedBox& box, const glm::dvec3& velocity) {
        SteadyBox steadily{.centre = box.centre,
                           .orientation = glm::quat_cast(box.axes),
                           .velocity = velocity,
                           .spin = drawn.uniform(0.0, 30.0) * drawn.direction(),
                           .half = box.half};
        steadily.radius = std::sqrt(glm::dot(box.half, box.half));
        return steadily;
    };
    Spinners both{steady(flight.a, glm::dvec3{0.0}), steady(flight.b, 0.1 * flight.velocity)};
    if (drawn.one_in(3)) both.a.spin = glm::dvec3{0.0};
    return both;
}

TEST(AdvanceToGap, FindsTheFirstTimeThatAThousandSmallStepsFind)
{
    constexpr int moments = 1000;
    std::uint64_t reached = 0;
    std::uint64_t cleared = 0;
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        const Spinners both = draw_spinners(seed);
        const double smallest = smallest_half(both.a.at(0.0), both.b.at(0.0));
        const GapSearch asked{
            .gap = -0.01 * smallest, .near = 1e-3 * smallest, .from = 0.0, .to = 1.0};
        if (both.gap_at(0.0) <= asked.gap + asked.near) continue;
        std::uint32_t steps = 10'000;
        const Advanced advanced = advance_to_gap(both.a, both.b, asked, steps);
        ASSERT_NE(advanced.end, Advanced::End::unfinished) << seed;
        for (int k = 0; k <= moments; ++k) { // until then it is open
            const double time = advanced.time * k / moments;
            ASSERT_GT(both.gap_at(time), asked.gap) << seed << " at " << time;
        }
        if (advanced.end == Advanced::End::clear) {
            EXPECT_EQ(advanced.time, asked.to) << seed;
            ++cleared;
        } else {
            EXPECT_LE(both.gap_at(advanced.time), asked.gap + asked.near) << seed;
            ++reached;
        }
    }
    EXPECT_GT(reached, pairs / 8);
    EXPECT_GT(cleared, pairs / 8);
}

} // namespace
} // namespace hapnet::scene::time_of_impact_test
