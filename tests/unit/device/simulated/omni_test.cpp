// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/omni.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

namespace hapnet::device::omni_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
constexpr OmniPlant plant{};
constexpr HandImpedance hand{};
constexpr double half_count = plant.resolution_m / 2;

SimulatedOmni omni_for(Task task) { return SimulatedOmni{Performer{.task = task}}; }

/// Reads each millisecond in (from, from + length]. Returns the last sample.
Sample read_for(SimulatedOmni& omni, base::TimePoint from, base::Duration length)
{
    Sample sample;
    for (auto time = base::Duration{1ms}; time <= length; time += 1ms) {
        sample = omni.read(from + time);
    }
    return sample;
}

/// The x of every sample of two seconds of a task.
std::vector<double> played(Task task, base::Seed seed, std::uint16_t peer_id)
{
    SimulatedOmni omni = omni_for(task);
    omni.on_cue({start, 10s, seed, peer_id, true});
    std::vector<double> xs;
    for (int ms = 0; ms < 2000; ++ms) xs.push_back(omni.read(start + ms * 1ms).hip.x());
    return xs;
}

TEST(SimulatedOmni, RestsWhereItIsBeforeItsCue)
{
    SimulatedOmni omni = omni_for(Task::t3);
    for (int ms = 0; ms < 1000; ++ms) {
        const Sample sample = omni.read(start + ms * 1ms);
        EXPECT_EQ(sample.hip.x(), 0.0);
        EXPECT_EQ(sample.hip.y(), 0.0);
        EXPECT_NEAR(sample.hip.z(), 0.035, half_count);
        EXPECT_EQ(sample.velocity, base::Velocity{});
        EXPECT_FALSE(sample.gripping);
    }
}

TEST(SimulatedOmni, StatesAnotherFrictionThanItHasWhereThatIsAsked)
{
    SimulatedOmni honest{{.plant = {.friction_n = 0.1}}};
    EXPECT_EQ(honest.capabilities().friction_n, 0.1);
    SimulatedOmni omni{{.plant = {.friction_n = 0.1, .stated_friction_n = 0.26}}};
    EXPECT_EQ(omni.capabilities().friction_n, 0.26);
}

// A first-order low-pass of 10 Hz reaches 1 - 1/e of a step after 1 / (2 pi 10 Hz) = 15.9 ms. The
// stiffness of the hand holds it, so that the place where it is slow follows the force.
TEST(SimulatedOmni, GivesAForceLateWhereItsBandwidthIsLimited)
{
    const HandImpedance light{.mass_kg = 0.001, .damping_ns_per_m = 0.5, .stiffness_n_per_m = 300};
    const auto place_after = [&](std::optional<double> bandwidth_hz, base::Duration time) {
        SimulatedOmni omni{{.task = Task::t3,
                            .person = {.hand = light},
                            .plant = {.friction_n = 0.0, .force_bandwidth_hz = bandwidth_hz}}};
        std::ignore = omni.read(start);
        omni.apply(ungoverned({{3.0, 0.0, 0.0}}));
        return read_for(omni, start, time).hip.x();
    };
    const double whole = place_after(std::nullopt, 1s);
    EXPECT_NEAR(whole, 0.01, 1e-4);
    EXPECT_NEAR(place_after(10.0, 1s), whole, 1e-4);
    EXPECT_NEAR(place_after(10.0, 17ms) / whole, 0.63, 0.05);
    EXPECT_GT(place_after(std::nullopt, 17ms), 0.98 * whole);
}

TEST(SimulatedOmni, GivesWayToAForceLikeASpringUpToItsFriction)
{
    for (const double newtons : {1.0, -2.0, 3.0}) {
        SimulatedOmni omni = omni_for(Task::t3);
        omni.apply(ungoverned({{newtons, 0.0, 0.0}}));
        const Sample sample = read_for(omni, start, 2s);
        EXPECT_NEAR(sample.hip.x(), newtons / hand.stiffness_n_per_m,
                    plant.friction_n / hand.stiffness_n_per_m + half_count)
            << newtons;
        EXPECT_EQ(sample.hip.y(), 0.0);
        EXPECT_NEAR(sample.velocity.x(), 0.0, 1e-6);
    }
}

TEST(SimulatedOmni, DoesNotBudgeForLessThanItsFriction)
{
    SimulatedOmni omni = omni_for(Task::t3);
    omni.apply(ungoverned({{0.25, -0.25, 0.25}}));
    const Sample sample = read_for(omni, start, 2s);
    EXPECT_EQ(sample.hip.x(), 0.0);
    EXPECT_EQ(sample.hip.y(), 0.0);
    EXPECT_NEAR(sample.hip.z(), 0.035, half_count);
}

TEST(SimulatedOmni, ReportsWholeCountsOnly)
{
    SimulatedOmni omni = omni_for(Task::t3);
    omni.on_cue({start, 10s, base::Seed{3}, 1, true});
    for (int ms = 0; ms < 3000; ++ms) {
        const auto hip = omni.read(start + ms * 1ms).hip;
        for (const double x : {hip.x(), hip.y(), hip.z()}) {
            const double counts = x / plant.resolution_m;
            EXPECT_NEAR(counts, std::round(counts), 1e-9);
        }
    }
}

TEST(SimulatedOmni, SaturatesAtItsPeakForce)
{
    SimulatedOmni asked_too_much = omni_for(Task::t3);
    SimulatedOmni at_its_peak = omni_for(Task::t3);
    asked_too_much.apply(ungoverned({{300.0, 0.0, 0.0}}));
    at_its_peak.apply(ungoverned({{plant.force_max_n, 0.0, 0.0}}));
    EXPECT_EQ(read_for(asked_too_much, start, 1s).hip, read_for(at_its_peak, start, 1s).hip);
}

TEST(SimulatedOmni, StopsAtTheEndsOfItsWorkspace)
{
    Operator weak;
    weak.hand.stiffness_n_per_m = 5.0;
    SimulatedOmni omni{{.task = Task::t3, .person = weak}};
    omni.apply(ungoverned({{-3.3, 0.0, 0.0}}));
    Sample sample = read_for(omni, start, 3s);
    EXPECT_NEAR(sample.hip.x(), -0.080, half_count);
    EXPECT_NEAR(sample.velocity.x(), 0.0, 1e-6);
    omni.apply(ungoverned({{0.0, 3.3, 0.0}}));
    sample = read_for(omni, start + 3s, 3s);
    EXPECT_NEAR(sample.hip.y(), 0.060, half_count);
    omni.apply(ungoverned({{0.0, 0.0, -3.3}}));
    sample = read_for(omni, start + 6s, 3s);
    EXPECT_NEAR(sample.hip.z(), -0.035, half_count);
}

TEST(SimulatedOmni, DoesNotLiveThroughAGapOfMoreThan100Ms)
{
    SimulatedOmni omni = omni_for(Task::t3);
    std::ignore = omni.read(start);
    omni.apply(ungoverned({{3.0, 0.0, 0.0}}));
    EXPECT_EQ(omni.read(start + 101ms).hip.x(), 0.0);
    EXPECT_GT(omni.read(start + 201ms).hip.x(), 0.001);
}

TEST(SimulatedOmni, MovesOnlyWithTheTimeThatPasses)
{
    SimulatedOmni omni = omni_for(Task::t3);
    std::ignore = omni.read(start);
    omni.apply(ungoverned({{3.0, 0.0, 0.0}}));
    for (int i = 0; i < 100; ++i) EXPECT_EQ(omni.read(start).hip.x(), 0.0);
    EXPECT_EQ(omni.read(start + 1us).hip.x(), 0.0);
}

TEST(SimulatedOmni, GoesToItsPartWithoutAJumpWhenCued)
{
    SimulatedOmni omni = omni_for(Task::t3);
    Sample before = read_for(omni, start, 100ms);
    omni.on_cue({start + 1s, 10s, base::Seed{1}, 1, true});
    double fastest = 0.0;
    for (int ms = 101; ms <= 1100; ++ms) {
        const Sample sample = omni.read(start + ms * 1ms);
        EXPECT_LT(base::norm(sample.hip - before.hip), 0.0005) << ms; // 0.5 m/s
        fastest = std::max(fastest, base::norm(sample.velocity));
        before = sample;
    }
    EXPECT_GT(fastest, 0.02);
    // At its part: 21 mm left of the path's start, up to friction and its own involuntary motion.
    EXPECT_NEAR(before.hip.x(), -0.021, 0.0013 + 0.0021 + half_count);
    EXPECT_NEAR(before.hip.z(), 0.0, 0.0013 + half_count);
}

TEST(SimulatedOmni, GripsWhatItsTaskHolds)
{
    SimulatedOmni omni = omni_for(Task::p1);
    omni.on_cue({start + 100ms, 1s, base::Seed{1}, 1, true});
    EXPECT_FALSE(read_for(omni, start, 99ms).gripping);
    EXPECT_TRUE(omni.read(start + 100ms).gripping);
    EXPECT_FALSE(omni.read(start + 1100ms).gripping);
}

TEST(SimulatedOmni, PlaysTheSameForTheSameSeedAndPeer)
{
    EXPECT_EQ(played(Task::t3, base::Seed{7}, 1), played(Task::t3, base::Seed{7}, 1));
    EXPECT_NE(played(Task::t3, base::Seed{7}, 1), played(Task::t3, base::Seed{8}, 1));
    EXPECT_NE(played(Task::t3, base::Seed{7}, 1), played(Task::t3, base::Seed{7}, 2));
}

TEST(SimulatedOmni, PlaysThePrescribedPathOfP1WithoutChance)
{
    EXPECT_EQ(played(Task::p1, base::Seed{7}, 1), played(Task::p1, base::Seed{8}, 2));
}

TEST(SimulatedOmni, PlaysP1AlikeHoweverThePersonWaversAndReacts)
{
    const auto xs = [](const Operator& person) {
        SimulatedOmni omni{{.task = Task::p1, .person = person}};
        omni.on_cue({start, 10s, base::Seed{7}, 1, true});
        std::vector<double> result;
        for (int ms = 0; ms < 2000; ++ms) result.push_back(omni.read(start + ms * 1ms).hip.x());
        return result;
    };
    EXPECT_EQ(xs(operator_named("nominal").value()), xs(operator_named("lifelike").value()));
}

TEST(SimulatedOmni, PushesOnWhereItsTaskAsksForAForceThatItDoesNotFeel)
{
    // Without a body there, the hand moves on by 10 mm per second and newton, from 150 ms after the
    // script wants 0.71 N, smoothed over 106 ms.
    SimulatedOmni omni = omni_for(Task::t5);
    omni.on_cue({start, 30s, base::Seed{1}, 1, true});
    const auto noise = [](double seconds) {
        return HandNoise{base::Seed{1}, 1, {}}.at(seconds).away_m;
    };
    std::ignore = read_for(omni, start, 2s);
    const double aim = -0.025 + 0.71 * (1.0 / 200.0 + 1.0 / 500.0);
    const Sample sample = read_for(omni, start + 2s, 1s);
    const double farther = sample.hip.x() - aim - noise(3.0);
    const double expected = 0.010 * 0.71 * (1.0 - 0.150 - 0.106);
    EXPECT_NEAR(farther, expected, plant.friction_n / hand.stiffness_n_per_m + 0.0005);
}

TEST(SimulatedOmni, SaysThatItIsSimulated)
{
    EXPECT_EQ(description(omni_for(Task::p1)),
              "sim: simulated Omni (held by a simulated hand, nominal: 0.2 kg, 5 N s/m, 200 N/m)");
}

} // namespace
} // namespace hapnet::device::omni_test
