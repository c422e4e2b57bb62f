// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The step that ends a crowded tick, against the balance of energy and momentum.
#include "scene/one_box/rest_of_tick.hpp"

#include "proto/base/random.hpp"
#include "tests/unit/scene/one_box/rig.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::rest_of_tick_test {
namespace {

class Chance {
public:
    explicit Chance(std::uint64_t seed) : stream_{base::Seed{seed}.stream("sliding/rest")} {}

    double between(double low, double high)
    {
        return low + (high - low) * stream_.uniform(next_++);
    }
    double power(double low, double high)
    {
        double value = low;
        for (double left = between(0.0, std::log2(high / low)); left > 0.0; left -= 1.0)
            value *= left < 1.0 ? 1.0 + left : 2.0;
        return value;
    }
    PerAxis vector(double size)
    {
        PerAxis v{};
        for (double& part : v) part = between(-size, size);
        return v;
    }

private:
    base::RandomStream stream_;
    std::uint64_t next_ = 0;
};

double stored(const HandDescription& hands, double depth)
{
    const double bend = hands.force_max_n / hands.stiffness_n_per_m;
    if (depth <= 0.0) return 0.0;
    return depth < bend ? 0.5 * hands.stiffness_n_per_m * depth * depth
                        : hands.force_max_n * (depth - 0.5 * bend);
}

/// A box that many springs push, a third of a tick before its end.
class Crowd {
public:
    Crowd(Chance& chance, bool damped, bool holding, const Description& scene)
        : description_{scene}, config_{.planes = scene.planes}, state_{.bodies = Bodies{scene}}
    {
        tick_ = chance.power(1e-4, 1e-2);
        mass_ = description_.bodies[0].mass_kg;
        hands_.stiffness_n_per_m = chance.power(1e-2, 1e6) * mass_ / (tick_ * tick_);
        if (damped) hands_.damping_ns_per_m = chance.power(1e-2, 1e2) * mass_ / tick_;
        if (!damped) hands_.damping_ns_per_m = 0.0;
        hands_.force_max_n = chance.power(1e-2, 1e4) * mass_ / tick_;
        oscillators_.emplace_back(hands_, state_.bodies.properties[0], tick_);
        obstacles_.emplace_back(config_, state_.bodies, state_.bodies.properties[0]);
        box_.emplace_back(hands_, oscillators_[0], obstacles_[0], room_);
        BoxMotion& box = this->box();
        box.time_left = tick_ / 3.0;
        box.position = {};
        box.velocity = chance.vector(1.0);
        for (AxisMotion& axis : box.axes) {
            axis = {};
            axis.applied_acceleration = chance.between(-20.0, 20.0);
        }
        box.is_on_plane = false;
        box.is_exact = false;
        add_springs(chance, holding);
    }

    BoxMotion& box() { return box_[0]; }
    [[nodiscard]] const HandDescription& hands() const { return hands_; }
    [[nodiscard]] double mass() const { return mass_; }

    /// Kinetic energy and what the springs store.
    double energy()
    {
        const BoxMotion& now = box();
        double sum = 0.5 * mass_ * dot(now.velocity, now.velocity);
        for (const FaceSpring& each : now.active_springs()) sum += stored(hands_, each.depth);
        for (const SlantedSpring& each : now.active_slanted()) sum += stored(hands_, each.depth);
        for (const GripSpring& each : now.active_grips())
            sum += 0.5 * hands_.stiffness_n_per_m * dot(each.stretch, each.stretch);
        return sum;
    }
    /// The work of the hands' motion so far. A hand approaches by `closing`.
    double work_of_hands()
    {
        double sum = 0.0;
        for (const FaceSpring& each : box().active_springs()) sum += each.impulse * each.closing;
        for (const SlantedSpring& each : box().active_slanted()) sum += each.impulse * each.closing;
        for (const GripSpring& each : box().active_grips()) sum += dot(each.impulse, each.velocity);
        return sum;
    }

private:
    void add_springs(Chance& chance, bool holding)
    {
        BoxMotion& now = box();
        const auto start = [&](Spring& spring) {
            spring.depth = chance.between(-1.0, 1.0) * chance.power(1e-6, 1e-1);
            spring.closing = chance.between(-1.0, 1.0);
            spring.impulse = 0.0;
            spring.phase = SpringPhase::pressing;
        };
        for (int i = 0; i < 3; ++i) {
            FaceSpring& spring = now.springs[now.spring_count++];
            start(spring);
            spring.axis = static_cast<std::size_t>(chance.between(0.0, 2.999));
            spring.sign = chance.between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
        }
        for (int i = 0; i < 3; ++i) {
            SlantedSpring& spring = now.slanted[now.slanted_count++];
            start(spring);
            spring.normal = chance.vector(1.0);
            const double size = std::sqrt(dot(spring.normal, spring.normal));
            for (double& part : spring.normal) part /= size;
        }
        if (holding) now.grips[now.grip_count++] = {0, chance.vector(0.01), chance.vector(1.0), {}};
    }

    Description description_;
    WorldConfig config_;
    WorldState state_;
    HandDescription hands_;
    double tick_ = 0.0;
    double mass_ = 0.0;
    TickRoom room_;
    std::vector<AxisOscillators> oscillators_; // made once all other members are known
    std::vector<Obstacles> obstacles_;
    std::vector<BoxMotion> box_;
};

PerAxis given_by_springs(const BoxMotion& box)
{
    PerAxis sum{};
    for (const FaceSpring& each : box.active_springs()) each.add_along(sum, -each.impulse);
    for (const SlantedSpring& each : box.active_slanted()) each.add_along(sum, -each.impulse);
    for (const GripSpring& each : box.active_grips()) {
        for (std::size_t i = 0; i < 3; ++i) sum[i] += each.impulse[i];
    }
    return sum;
}

struct Outcome {
    double gain;  // J, beyond the work of hands and steady forces
    double there; // J, the sum of all amounts
    double open;  // N s of momentum that no impulse explains
};

Outcome finish(Crowd& crowd)
{
    BoxMotion& box = crowd.box();
    const double before = crowd.energy();
    const PerAxis velocity = box.velocity;
    const PerAxis position = box.position;
    const double time = box.time_left;
    finish_tick(box);
    EXPECT_EQ(box.time_left, 0.0);
    double work = crowd.work_of_hands();
    double there = before + crowd.energy() + std::abs(work);
    const PerAxis given = given_by_springs(box);
    double open = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double steady = crowd.mass() * box.axes[i].applied_acceleration;
        work += steady * (box.position[i] - position[i]);
        there += std::abs(steady * (box.position[i] - position[i]));
        const double gained = crowd.mass() * (box.velocity[i] - velocity[i]);
        open = std::max(open, std::abs(gained - given[i] - time * steady));
    }
    for (const Spring& each : box.active_springs()) {
        EXPECT_GE(each.impulse, 0.0);
        EXPECT_LE(each.impulse, crowd.hands().force_max_n * time * (1.0 + 1e-12));
    }
    for (const Spring& each : box.active_slanted()) {
        EXPECT_GE(each.impulse, 0.0);
        EXPECT_LE(each.impulse, crowd.hands().force_max_n * time * (1.0 + 1e-12));
    }
    return {crowd.energy() - before - work, there, open};
}

TEST(RestOfTick, KeepsEnergyWithSpringsOfAnyStiffnessAndLosesItWithDampers)
{
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Chance chance{seed};
        const bool damped = seed % 3 == 0;
        Crowd crowd{chance, damped, seed % 5 == 0, lone_cube()};
        const Outcome outcome = finish(crowd);
        if (!damped) {
            EXPECT_GE(outcome.gain, -1e-9 * outcome.there) << seed;
        }
        EXPECT_LE(outcome.gain, 1e-9 * outcome.there) << seed;
    }
}

TEST(RestOfTick, GivesTheBoxTheImpulsesThatItBooks)
{
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Chance chance{seed};
        Crowd crowd{chance, true, true, lone_cube()};
        const double amount = std::sqrt(2.0 * crowd.mass() * crowd.energy());
        EXPECT_LE(finish(crowd).open, 1e-9 * amount) << seed;
    }
}

TEST(RestOfTick, NeverEntersAnObstacleNorGainsFromOne)
{
    Description scene = cube_on_platform(0.5);
    for (const double x : {-0.05, 0.05}) {
        BodyDescription wall{.name = "wall", .movable = false};
        wall.position = {{x, 0.0, 0.0}};
        wall.half = {0.005, 1e2, 1e2};
        scene.bodies.push_back(wall);
    }
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Chance chance{seed};
        Crowd crowd{chance, false, seed % 5 == 0, scene};
        const Outcome outcome = finish(crowd);
        EXPECT_LE(outcome.gain, 1e-9 * outcome.there) << seed;
        EXPECT_LE(std::abs(crowd.box().position[0]), 0.025) << seed;
        EXPECT_GE(crowd.box().position[1], 0.0) << seed;
    }
}

} // namespace
} // namespace hapnet::scene::rest_of_tick_test
