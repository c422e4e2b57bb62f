// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/passivity.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::peer::passivity_test {
namespace {

constexpr double tick = 1e-3;

/// The energy in a whole run that a hand draws from a sampled wall while it moves as sin(2 pi f t),
/// J: the wall's force is held over each tick; its velocity is the difference of two samples. 200
/// ticks; f a multiple of 5 Hz, so that the run is a whole number of periods.
double energy_drawn(const VirtualWall& wall, double port_damping, double frequency)
{
    constexpr int ticks = 200;
    constexpr int parts = 64; // of a tick, for the port's own damping
    const double omega = base::two_pi * frequency;
    const auto at = [&](double t) { return base::sin(omega * t); };
    double energy = 0.0;
    for (int i = 0; i < ticks; ++i) {
        const double now = i * tick;
        const double velocity = (at(now) - at(now - tick)) / tick;
        const double force = -(wall.stiffness_n_per_m * at(now) + wall.damping_ns_per_m * velocity);
        energy += force * (at(now + tick) - at(now));
        for (int part = 0; part < parts; ++part) {
            const double v = omega * base::cos(omega * (now + (part + 0.5) * tick / parts));
            energy -= port_damping * v * v * tick / parts;
        }
    }
    return energy;
}

/// The largest energy over all frequencies below half the sampling rate.
double most_drawn(const VirtualWall& wall, double port_damping)
{
    double most = -1e300;
    for (int f = 5; f < 500; f += 5) {
        most = std::max(most, energy_drawn(wall, port_damping, f));
    }
    return most;
}

TEST(Passivity, NoMotionDrawsEnergyFromAWallWithinTheBound)
{
    for (const VirtualWall& wall : {VirtualWall{500.0, 0.0}, VirtualWall{500.0, 2.0},
                                    VirtualWall{8000.0, 1.0}, VirtualWall{0.0, 3.0}}) {
        EXPECT_LE(most_drawn(wall, damping_for_passivity(wall, tick)), 1e-9)
            << wall.stiffness_n_per_m << " N/m, " << wall.damping_ns_per_m << " N s/m";
    }
}

/// The energy per tick that the fastest visible motion draws, to and fro from one sample to the
/// next, J. There the bound is exact.
double energy_of_a_zigzag(const VirtualWall& wall, double port_damping)
{
    const double speed = 2.0 / tick; // between places of +1 and -1
    const double force = -(wall.stiffness_n_per_m + wall.damping_ns_per_m * speed); // at +1
    return force * -2.0 - port_damping * speed * speed * tick;
}

TEST(Passivity, ToAndFroFromSampleToSampleDrawsEnergyAsSoonAsTheBoundIsPassed)
{
    for (const VirtualWall& wall : {VirtualWall{500.0, 2.0}, VirtualWall{8000.0, 1.0}}) {
        const double bound = damping_for_passivity(wall, tick);
        EXPECT_LT(energy_of_a_zigzag(wall, 1.001 * bound), 0.0);
        EXPECT_GT(energy_of_a_zigzag(wall, 0.999 * bound), 0.0);
    }
}

TEST(Passivity, ThePapersWallNeedsTwoAndAQuarter)
{
    EXPECT_DOUBLE_EQ(damping_for_passivity({500.0, 2.0}, tick), 2.25);
    EXPECT_DOUBLE_EQ(damping_for_passivity({1000.0, 0.0}, tick), 0.5);
}

TEST(Passivity, AStifferWallIsRenderedSofterAndThenWithinTheBound)
{
    EXPECT_EQ(passive_share({500.0, 2.0}, tick, 4.0), 1.0);
    const VirtualWall stiff{20'000.0, 2.0};
    const double share = passive_share(stiff, tick, 4.0);
    EXPECT_LT(share, 1.0);
    const VirtualWall rendered{share * stiff.stiffness_n_per_m, share * stiff.damping_ns_per_m};
    EXPECT_NEAR(damping_for_passivity(rendered, tick), 4.0, 1e-12);
    EXPECT_EQ(passive_share(stiff, tick, 0.0), 0.0);
}

} // namespace
} // namespace hapnet::peer::passivity_test
