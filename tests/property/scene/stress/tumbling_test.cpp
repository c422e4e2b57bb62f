// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// A box with three unequal edges, dropped with spin, tumbles to rest and gains no energy while it
// moves. The energy that lifts it out of the floor at rest falls with the tick.
#include "scene/world.hpp"
#include "tests/support/scene/dice.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::test {
namespace {

constexpr double weight_n = 0.1 * 9.81;

scene::Description dropped_box(double friction, std::uint64_t seed)
{
    scene::Description drawn;
    Dice dice{base::Seed{seed}.stream("spin")};
    scene::BodyDescription box{.name = "box", .half = {0.03, 0.02, 0.01}};
    box.position = {{0.0, 0.2, 0.0}};
    box.angular_velocity = 30.0 * dice.vector();
    box.material.friction = friction;
    drawn.bodies.push_back(box);
    drawn.planes.push_back({.name = "floor", .material = {.friction = friction}});
    drawn.hands.count = 0;
    return drawn;
}

double energy_of(const scene::World& world, const scene::BodyDescription& form)
{
    const scene::BodyState state = world.body(0);
    const glm::dvec3 momentum = world.state().bodies.angular_momentum.at(0);
    const glm::dvec3 own = glm::conjugate(state.orientation) * momentum;
    const glm::dvec3& v = state.velocity.value;
    return 0.5 * form.mass_kg * glm::dot(v, v) + weight_n * state.position.value.y +
           0.5 * glm::dot(own, own / scene::box_inertia(form.mass_kg, form.half));
}

/// True if the box moves faster than about 0.1 mm/s, enough to pay for a lift.
bool moves(const scene::World& world) { return world.state().bodies.kinetic_energy(0) > 1e-9; }

/// The sum of the energy gains over a second's ticks, J; the box starts with 0.2 J.
double gained(const scene::Description& drawn, base::Duration tick)
{
    auto world = scene::World::freeze(drawn, {.tick = tick, .sleeping = false});
    double sum = 0.0;
    double before = energy_of(*world, drawn.bodies[0]);
    for (auto time = base::Duration::zero(); time < std::chrono::seconds{1}; time += tick) {
        world->tick();
        const double after = energy_of(*world, drawn.bodies[0]);
        if (moves(*world)) {
            EXPECT_LT(after - before, 1e-12);
        }
        sum += std::max(0.0, after - before);
        before = after;
    }
    return sum;
}

class Tumbling : public testing::TestWithParam<double> {};

TEST_P(Tumbling, GainsNoEnergyWhileItMoves)
{
    using std::chrono::microseconds;
    double coarse = 0.0;
    double fine = 0.0;
    constexpr std::uint64_t boxes = 12;
    for (std::uint64_t seed = 0; seed < boxes; ++seed) {
        const scene::Description drawn = dropped_box(GetParam(), seed);
        const double gain = gained(drawn, microseconds{1000});
        EXPECT_LT(gain, 3e-6) << "seed " << seed;
        coarse += gain;
        fine += gained(drawn, microseconds{100});
    }
    EXPECT_LT(coarse / boxes, 5e-7);
    constexpr double rounding = 1e-12;
    EXPECT_LT(fine, 0.1 * coarse + rounding);
}

INSTANTIATE_TEST_SUITE_P(OfFriction, Tumbling, testing::Values(0.0, 0.4, 2.0),
                         [](const auto& each) {
                             return "Percent" + std::to_string(std::lround(100.0 * each.param));
                         });

} // namespace
} // namespace hapnet::test
