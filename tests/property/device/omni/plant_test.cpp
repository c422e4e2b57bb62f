// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/joints/plant.hpp"

#include <chrono>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

const base::Position inkwell = omni::position_of(omni::inkwell_pose);

/// A plant that a hand holds still at a place.
JointPlant held_at(const base::Position& place, const JointPlantFigures& figures = {})
{
    JointPlant plant{figures};
    plant.set_grip(Grip{place, {}, {}});
    plant.advance(3s);
    return plant;
}

double energy_of(const JointPlant& plant, double mass)
{
    const glm::dvec3 v = plant.tip_velocity().value;
    const glm::dvec3 turning = plant.turning();
    return 0.5 * mass * glm::dot(v, v) +
           0.5 * glm::dot(plant.figures().rotor_kg_m2 * turning, turning);
}

TEST(JointPlant, RestsInItsInkwellUntilItIsPulledOut)
{
    JointPlant plant;
    EXPECT_TRUE(plant.is_docked());
    plant.set_grip(Grip{{inkwell.value + glm::dvec3{0.0, 0.0045, 0.0}}, {}, {}}); // 0.9 N
    plant.set_torque(omni::torque_max_nm);
    plant.advance(1s);
    EXPECT_TRUE(plant.is_docked());
    EXPECT_EQ(plant.tip(), inkwell);
    plant.set_torque({});
    plant.set_grip(Grip{{}, {}, {}});
    plant.advance(2s);
    EXPECT_FALSE(plant.is_docked());
    plant.set_grip(Grip{inkwell, {}, {}});
    plant.advance(3s);
    EXPECT_TRUE(plant.is_docked());
}

TEST(JointPlant, GivesWayToTorquesByTheHandsStiffness)
{
    JointPlantFigures figures;
    figures.friction_nm = {};
    for (const glm::dvec3& place : {glm::dvec3{0.0}, glm::dvec3{0.06, -0.04, 0.02}}) {
        for (const glm::dvec3& newtons : {glm::dvec3{1, 0, 0}, glm::dvec3{0.3, -1.2, 0.8}}) {
            JointPlant plant = held_at({place}, figures);
            // At rest the hand's force balances that of the motors where it is.
            for (int i = 0; i < 2000; ++i) {
                plant.set_torque(glm::transpose(omni::jacobian(plant.joints())) * newtons);
                plant.advance(1ms);
            }
            const glm::dvec3 given_way = plant.tip().value - place;
            EXPECT_LT(glm::length(given_way - newtons / 200.0), 1e-9);
        }
    }
}

TEST(JointPlant, DoesNotBudgeForLessThanItsFriction)
{
    JointPlant plant = held_at({});
    const glm::dvec3 before = plant.joints().angles;
    plant.set_torque(0.9 * plant.figures().friction_nm - plant.torque());
    plant.set_grip(Grip{plant.tip(), {}, {}}); // no pull of its own
    plant.advance(2s);
    // The iterations for the joints' friction leave some nanometres per second.
    EXPECT_LT(glm::length(plant.joints().angles - before), 1e-7);
    plant.set_torque(1.5 * plant.figures().friction_nm);
    plant.advance(2s);
    EXPECT_GT(glm::length(plant.joints().angles - before), 1e-3);
}

TEST(JointPlant, KeepsItsEnergyWithoutFrictionAndLosesItWithIt)
{
    JointPlantFigures figures;
    figures.friction_nm = {};
    figures.tip_damping_ns_per_m = 0.0;
    JointPlant plant = held_at({}, figures);
    plant.set_grip(std::nullopt);
    plant.set_torque({0.05, 0.02, -0.02});
    plant.advance(50ms);
    plant.set_torque({});
    const double before = energy_of(plant, figures.tip_mass_kg);
    ASSERT_GT(before, 1e-3);
    plant.advance(30ms); // still away from the stops
    // First order in the step of 50 us: a share of the angle turned in a step, 4e-4 rad.
    EXPECT_NEAR(energy_of(plant, figures.tip_mass_kg) / before, 1.0, 1e-3);
}

TEST(JointPlant, ComesToRestByItsFriction)
{
    JointPlant plant = held_at({});
    plant.set_grip(std::nullopt);
    plant.set_torque({0.1, 0.05, -0.05});
    plant.advance(30ms);
    plant.set_torque({});
    double before = energy_of(plant, omni::tip_mass_kg);
    for (int ms = 0; ms < 2000; ++ms) {
        plant.advance(1ms);
        const double now = energy_of(plant, omni::tip_mass_kg);
        ASSERT_LE(now, before * (1.0 + 1e-9));
        before = now;
    }
    EXPECT_LT(glm::length(plant.turning()), 1e-8); // see DoesNotBudge...
}

TEST(JointPlant, StaysWithinItsStopsAndFiniteWhateverItsMotorsAreTold)
{
    JointPlant plant = held_at({});
    plant.set_grip(std::nullopt);
    for (int ms = 0; ms < 3000; ++ms) {
        const double sign = (ms / 37) % 2 == 0 ? 1e9 : -1e9;
        plant.set_torque(ms % 101 == 0 ? glm::dvec3{std::numeric_limits<double>::quiet_NaN()}
                                       : glm::dvec3{sign, -sign, (ms / 53) % 2 == 0 ? 1e9 : -1e9});
        plant.advance(1ms);
        ASSERT_TRUE(omni::is_reachable(plant.joints(), 1e-9));
        ASSERT_TRUE(base::is_finite(plant.turning()));
        ASSERT_LE(glm::length(plant.torque()), glm::length(omni::torque_max_nm) * (1.0 + 1e-12));
    }
}

TEST(JointPlant, IsStableInTheStiffestAndTheLightestHand)
{
    for (const HandImpedance& hand :
         {HandImpedance{0.05, 2.0, 1250.0}, HandImpedance{2.0, 10.0, 50.0},
          HandImpedance{0.05, 10.0, 1250.0}}) {
        JointPlant plant;
        plant.set_grip(Grip{{}, {}, hand});
        plant.advance(4s);
        // Friction may leave this error, in the worst direction: 0.4 N.
        EXPECT_LT(base::norm(plant.tip() - base::Position{}), 0.4 / hand.stiffness_n_per_m);
        EXPECT_LT(base::norm(plant.tip_velocity()), 1e-8); // see DoesNotBudge...
    }
}

TEST(JointPlant, LivesThroughTheSameTimeInTheSameWay)
{
    JointPlant first = held_at({{0.05, 0.0, 0.0}});
    JointPlant second = held_at({{0.05, 0.0, 0.0}});
    for (int ms = 0; ms < 100; ++ms) {
        for (JointPlant* plant : {&first, &second}) {
            plant->set_torque({0.01 * ms, 0.1, -0.1});
            plant->advance(1ms);
        }
    }
    EXPECT_EQ(first.joints().angles, second.joints().angles);
    EXPECT_EQ(first.counts(), second.counts());
}

} // namespace
} // namespace hapnet::device
