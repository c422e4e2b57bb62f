// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The faults that stop the force at once and are latched, and how an operator restarts it.
#include "tests/support/device/governed.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;
using test::along_x;
using Governance = test::Governed;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A hand that is pushed with 1 N and moves at 1 m/s at most.
Governance pushing()
{
    Governance governed = Governance::ramped_in({.speed_max_m_per_s = 1.0});
    governed.play(10, along_x(1.0));
    EXPECT_EQ(governed.given.force(), along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::active);
    return governed;
}

/// Expects zero force and motors off in this very tick, and from then on.
void expect_latched(Governance& governed, const Latched& cause)
{
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_FALSE(governed.given.motors_on());
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    EXPECT_EQ(governed.governor.fault(), cause);
    EXPECT_EQ(governed.play(3000, along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
}

TEST(GovernorStates, FollowTheDevicesLife)
{
    Governance governed;
    governed.speaks = false;
    governed.sample.calibrated = false;
    governed.play(200, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::off); // for any length of time
    governed.speaks = true;
    governed(along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::calibrating);
    EXPECT_EQ(governed.given.force(), base::Force{});
    governed.sample.calibrated = true;
    governed(along_x(1.0), false);
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    EXPECT_FALSE(governed.given.motors_on());
    governed(along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::ramping);
    EXPECT_TRUE(governed.given.motors_on());
    governed.play(1001, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::active);
    governed.sample.fault = Fault::overheat;
    governed(along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
}

TEST(GovernorStops, AtOnceWhenTheStylusIsDockedOrLosesItsCalibrationAndRampsInAfterwards)
{
    Governance governed = pushing();
    governed.sample.docked = true;
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    governed.sample.docked = false;
    EXPECT_NEAR(governed.play(500, along_x(1.0)).x(), 0.5, 1e-9);
    governed.sample.calibrated = false;
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::calibrating);
    governed.sample.calibrated = true;
    EXPECT_NEAR(governed.play(500, along_x(1.0)).x(), 0.5, 1e-9);
    EXPECT_EQ(governed.governor.counters().docked, 1U);
    EXPECT_EQ(governed.governor.counters().uncalibrated, 1U);
}

TEST(GovernorStops, WhenADeviceRepeatsItselfForTwentyMillisecondsAndGoesOnWhenItSpeaksAgain)
{
    Governance governed = pushing();
    governed.speaks = false;
    EXPECT_EQ(governed.play(19, along_x(1.0)), along_x(1.0));
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    EXPECT_EQ(governed.play(79, along_x(1.0)), base::Force{}); // 99 ms
    EXPECT_EQ(governed.governor.counters().silent, 80U);
    governed.speaks = true;
    EXPECT_NEAR(governed.play(500, along_x(1.0)).x(), 0.5, 1e-9);
    EXPECT_EQ(governed.governor.counters().faults.silence, 0U);
}

TEST(GovernorLatches, ATimeoutWhenADeviceRepeatsItselfForAHundredMilliseconds)
{
    Governance governed = pushing();
    governed.speaks = false;
    governed.play(99, along_x(1.0));
    expect_latched(governed, {Fault::timeout, Trip::silence});
    governed.speaks = true;
    EXPECT_EQ(governed.play(3000, along_x(1.0)), base::Force{}); // it does not restart by itself
    EXPECT_EQ(governed.governor.counters().faults.silence, 1U);
}

TEST(GovernorStops, WhenADeviceSaysItHeardNothingAndLatchesThatAfterAHundredMilliseconds)
{
    Governance governed = pushing();
    governed.sample.fault = Fault::timeout;
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.play(50, along_x(1.0)), base::Force{});
    governed.sample.fault = Fault::none; // a hiccup
    EXPECT_NEAR(governed.play(500, along_x(1.0)).x(), 0.5, 1e-9);
    governed.sample.fault = Fault::timeout;
    governed.play(99, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    expect_latched(governed, {Fault::timeout, Trip::silence});
}

TEST(GovernorLatches, NothingWhenTheLoopStoodStillWithoutForce)
{
    Governance governed = pushing();
    governed.play(100, along_x(1.0), false);
    EXPECT_EQ(governed.after(10s, along_x(1.0), false), base::Force{});
    governed.governor.latch({Fault::timeout, Trip::loop});
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    EXPECT_NEAR(governed.play(500, along_x(1.0)).x(), 0.5, 1e-9);
}

TEST(GovernorLatches, NothingForTheSilenceOfADeviceWithoutMotors)
{
    Governance governed{{.axes_out = 0}};
    governed(along_x(1.0));
    governed.speaks = false;
    EXPECT_EQ(governed.play(500, along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    EXPECT_EQ(governed.governor.counters().silent, 0U);
}

TEST(GovernorLatches, EveryFaultThatADeviceReports)
{
    for (const Fault fault : {Fault::communication, Fault::overheat, Fault::over_force,
                              Fault::disconnected, Fault::internal}) {
        Governance governed = pushing();
        governed.sample.fault = fault;
        expect_latched(governed, {fault, Trip::device});
        governed.sample.fault = Fault::none;
        EXPECT_EQ(governed.play(3000, along_x(1.0)), base::Force{});
        EXPECT_EQ(governed.governor.fault().fault, fault) << name_of(fault);
        EXPECT_EQ(governed.governor.counters().faults.device, 1U);
    }
}

TEST(GovernorLatches, OverVelocityAboveTheSpeedLimitAndNotAtIt)
{
    Governance governed = pushing();
    governed.sample.velocity = {{0.6, 0.8, 0.0}};
    EXPECT_EQ(governed.play(5, along_x(1.0)), along_x(1.0));
    governed.sample.velocity = {{0.6, 0.8001, 0.0}};
    expect_latched(governed, {Fault::over_velocity, Trip::speed});
    EXPECT_EQ(governed.governor.counters().faults.speed, 1U);
}

TEST(GovernorLatches, NothingForSpeedWhileNoForceCanBeFeltButWaits)
{
    Governance governed{{.speed_max_m_per_s = 1.0}};
    governed.sample.velocity = {{2.0, 0.0, 0.0}};
    EXPECT_EQ(governed.play(100, along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    EXPECT_EQ(governed.governor.counters().too_fast, 100U);
    governed.sample.velocity = {};
    EXPECT_NEAR(governed.play(500, along_x(1.0)).x(), 0.5, 1e-9);
}

TEST(GovernorLatches, OverVelocityOnAJumpWhateverVelocityTheDeviceReports)
{
    Governance governed = pushing();
    governed.sample.hip = {{0.0049, 0.0, 0.0}}; // in 1 ms, and 4 ms of grace
    EXPECT_EQ(governed.play(5, along_x(1.0)), along_x(1.0));
    governed.sample.hip = {{0.0049, 0.0051, 0.0}};
    expect_latched(governed, {Fault::over_velocity, Trip::jump});
    EXPECT_EQ(governed.governor.counters().faults.jump, 1U);
}

TEST(GovernorLatches, NothingWhenALateSampleHasMovedOn)
{
    Governance governed = pushing();
    governed.speaks = false;
    governed.play(15, along_x(1.0));
    governed.speaks = true;
    governed.sample.hip = {{0.015, 0.0, 0.0}}; // 16 ms at less than a metre a second
    EXPECT_EQ(governed(along_x(1.0)), along_x(1.0));
}

TEST(GovernorLatches, NothingForTheNoiseOfAnEncoder)
{
    Governance governed = pushing();
    for (int i = 0; i < 1000; ++i) {
        const double off = i % 2 == 0 ? 0.000055 : 0.0; // a count to and fro, unfiltered
        governed.sample.hip = {{off, off, off}};
        governed.sample.velocity = {{off / 0.001, off / 0.001, off / 0.001}};
        ASSERT_EQ(governed(along_x(1.0)), along_x(1.0));
    }
}

TEST(GovernorLatches, CommunicationWhenAPlaceOrVelocityIsNoNumber)
{
    for (const bool place : {true, false}) {
        Governance governed = pushing();
        (place ? governed.sample.hip.value : governed.sample.velocity.value).y = not_a_number;
        expect_latched(governed, {Fault::communication, Trip::nonsense});
        EXPECT_EQ(governed.governor.counters().faults.nonsense, 1U);
    }
}

TEST(GovernorLatches, ATimeoutWhenTheLoopStoodStillForMoreThanAHundredMilliseconds)
{
    Governance governed = pushing();
    EXPECT_EQ(governed.after(100ms, along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.fault(), Latched{});
    governed.play(1100, along_x(1.0));
    EXPECT_EQ(governed.after(100ms + 1ns, along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.fault(), (Latched{Fault::timeout, Trip::loop}));
    EXPECT_EQ(governed.governor.counters().faults.loop, 1U);
    EXPECT_EQ(governed.governor.counters().stalled, 2U);
}

TEST(GovernorLatches, TheSameAfterAStallWhetherOrNotAWatchdogSawItFirst)
{
    std::vector<Governance> both;
    for (const bool is_watchdog_first : {true, false}) {
        Governance& governed = both.emplace_back(Governance::ramped_in(
            {.force_continuous_n = 0.5, .speed_max_m_per_s = 1.0, .energy = EnergyLimits{}}));
        governed.play(10, along_x(1.0));
        if (is_watchdog_first) governed.governor.latch({Fault::timeout, Trip::loop});
        governed.sample.hip.value.x += 0.003;
        EXPECT_EQ(governed.after(150ms, along_x(1.0)), base::Force{});
        EXPECT_EQ(governed.governor.fault(), (Latched{Fault::timeout, Trip::loop}));
        EXPECT_GE(governed.governor.energy()->net_j, 0.003);
    }
    const Governor& a = both[0].governor;
    const Governor& b = both[1].governor;
    EXPECT_EQ(a.heat(), b.heat());
    EXPECT_EQ(a.energy()->net_j, b.energy()->net_j);
    EXPECT_EQ(a.energy()->work_5s_max_j, b.energy()->work_5s_max_j);
}

TEST(GovernorLatches, WhatAWatchdogSaysAndKeepsTheFirstCause)
{
    Governance governed = pushing();
    governed.governor.latch({Fault::timeout, Trip::loop});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    governed.sample.fault = Fault::disconnected;
    expect_latched(governed, {Fault::timeout, Trip::loop});
}

/// A fault that is over, but latched.
Governance latched()
{
    Governance governed = pushing();
    governed.sample.fault = Fault::communication;
    governed(along_x(1.0));
    governed.sample.fault = Fault::none;
    governed(along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    return governed;
}

void expect_ramps_in(Governance& governed)
{
    EXPECT_NE(governed.governor.state(), GovernorState::fault);
    EXPECT_EQ(governed.governor.counters().resets, 1U);
    EXPECT_NEAR(governed.play(500, along_x(1.0)).x(), 0.5, 2e-3);
    governed.play(600, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::active);
}

TEST(GovernorRecovers, WhenTheStylusIsPutIntoItsHolder)
{
    Governance governed = latched();
    governed.sample.docked = true;
    EXPECT_EQ(governed.play(49, along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    governed.sample.docked = false;
    expect_ramps_in(governed);
}

TEST(GovernorRecovers, NotByAHoldersSwitchThatFlickers)
{
    Governance governed = latched();
    for (int i = 0; i < 400; ++i) {
        governed.sample.docked = i % 40 != 0;
        governed(along_x(1.0));
    }
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
}

TEST(GovernorRecovers, WhenTheStylusWasPutIntoItsHolderWhileTheDeviceWasStillAtFault)
{
    Governance governed = pushing();
    governed.sample.fault = Fault::not_calibrated;
    governed.play(100, along_x(1.0));
    governed.sample.docked = true; // as this fault requires
    governed.play(50, along_x(1.0));
    governed.sample.fault = Fault::none;
    governed.play(51, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
    governed.sample.docked = false;
    expect_ramps_in(governed);
}

TEST(GovernorRecovers, NotByAStylusThatLayInItsHolderAllTheTime)
{
    Governance governed = pushing();
    governed.sample.docked = true;
    governed.sample.fault = Fault::communication;
    governed(along_x(1.0));
    governed.sample.fault = Fault::none;
    governed.play(100, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    governed.sample.docked = false;
    governed.play(100, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    governed.sample.docked = true;
    governed.play(50, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::ready);
}

/// Presses the button for `ticks` ticks, and releases it.
void press(Governance& governed, int ticks)
{
    governed.sample.buttons = 1;
    ++governed.sample.presses;
    governed.play(ticks, along_x(1.0));
    governed.sample.buttons = 0;
}

TEST(GovernorRecovers, WhenTheButtonIsPressedAfterASecondAtRestAndHeldForThreeTenths)
{
    Governance governed = latched();
    EXPECT_EQ(governed.play(1001, along_x(1.0)), base::Force{});
    governed.sample.buttons = 1;
    EXPECT_EQ(governed.play(300, along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_NE(governed.governor.state(), GovernorState::fault);
    governed.sample.buttons = 0;
    expect_ramps_in(governed);
}

TEST(GovernorRecovers, NotByAButtonThatFlickersOrIsPressedShortly)
{
    Governance governed = latched();
    governed.play(1001, {});
    for (int i = 0; i < 200; ++i) {
        press(governed, 1);
        governed.play(i % 3, {});
    }
    for (int i = 0; i < 10; ++i) {
        governed.play(1200, {});
        press(governed, 290);
    }
    governed.play(1200, {});
    ++governed.sample.presses; // and released, between two samples
    governed.play(10, {});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
}

TEST(GovernorRecovers, NotByAButtonWhileTheStylusMovesOrJustDid)
{
    Governance governed = latched();
    governed.sample.velocity = {{0.06, 0.0, 0.0}};
    governed.play(2000, {});
    press(governed, 400);
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    governed.play(1, {});
    governed.sample.velocity = {};
    governed.play(900, {});
    press(governed, 400);
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    governed.play(200, {});
    press(governed, 400);
    EXPECT_NE(governed.governor.state(), GovernorState::fault);
}

TEST(GovernorRecovers, NotByAButtonThatIsHeldDownOrWasPressedBefore)
{
    Governance governed = pushing();
    governed.sample.buttons = 1;
    governed.sample.presses = 7;
    governed.sample.fault = Fault::communication;
    governed({});
    governed.sample.fault = Fault::none;
    governed.play(3000, {});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    governed.sample.buttons = 0;
    governed.play(3000, {});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
}

TEST(GovernorRecovers, NotWhileTheDeviceIsStillAtFaultOrSilent)
{
    Governance governed = latched();
    governed.sample.fault = Fault::overheat;
    governed.play(2000, {});
    press(governed, 400);
    governed.sample.docked = true;
    governed({});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
    governed.sample.fault = Fault::none;
    governed.speaks = false;
    governed.play(2000, {});
    press(governed, 400);
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
}

TEST(GovernorRecovers, ByAnOperatorsWordUntilTheNextTickFindsTheFaultAgain)
{
    Governance governed = latched();
    governed.governor.reset();
    expect_ramps_in(governed);
    governed.sample.fault = Fault::overheat;
    governed({});
    governed.governor.reset();
    EXPECT_EQ(governed(along_x(1.0)), base::Force{});
    EXPECT_EQ(governed.governor.state(), GovernorState::fault);
}

/// As pushing(), on a device whose motion has to fit the force.
Governance checked(double newtons)
{
    Governance governed = Governance::ramped_in({.checks_motion = true, .speed_max_m_per_s = 1.0});
    governed.play(10, along_x(newtons));
    return governed;
}

TEST(GovernorLatches, AnEncoderThatStandsStillUnderForce)
{
    Governance governed = checked(1.0);
    governed.play(2980, along_x(1.0));
    EXPECT_EQ(governed.governor.state(), GovernorState::active);
    governed.play(20, along_x(1.0));
    expect_latched(governed, {Fault::communication, Trip::frozen});
    EXPECT_EQ(governed.governor.counters().faults.frozen, 1U);
}

TEST(GovernorLatches, NoEncoderThatCountsOrIsHardlyPushedOrHasNothingNewToSay)
{
    Governance trembling = checked(1.0);
    for (int i = 0; i < 10'000; ++i) {
        trembling.sample.hip = {{i % 2000 < 1000 ? 0.0 : 5e-5, 0.0, 0.0}};
        trembling(along_x(1.0));
    }
    EXPECT_EQ(trembling.governor.state(), GovernorState::active);
    Governance light = checked(0.4);
    light.play(10'000, along_x(0.4));
    EXPECT_EQ(light.governor.state(), GovernorState::active);
    Governance slow = checked(1.0); // 125 reports a second, as HID has
    for (int i = 0; i < 10'000; ++i) {
        slow.speaks = i % 8 == 0;
        if (slow.speaks) slow.sample.hip.value.x = 1e-4 * (i % 16);
        slow(along_x(1.0));
    }
    EXPECT_EQ(slow.governor.state(), GovernorState::active);
}

TEST(GovernorLatches, ADeviceThatSpeedsUpAgainstItsOwnForce)
{
    Governance governed = checked(2.0);
    for (int i = 0; i < 60 && governed.governor.state() != GovernorState::fault; ++i) {
        governed.sample.velocity.value.x -= 0.010; // 10 m/s2 the wrong way: 2 N on 200 g
        governed.sample.hip.value.x += 1e-3 * governed.sample.velocity.value.x;
        governed(along_x(2.0));
    }
    EXPECT_EQ(governed.governor.fault(), (Latched{Fault::over_velocity, Trip::runaway}));
    EXPECT_LE(-governed.sample.velocity.x(), 0.42) << "far below the limit of 1 m/s";
    EXPECT_EQ(governed.governor.counters().faults.runaway, 1U);
}

TEST(GovernorLatches, NoHandThatRunsIntoAForceOrIsPushedBackByIt)
{
    Governance governed = checked(0.0);
    double velocity = -0.6; // into the cube, which stops it and throws it back
    for (int i = 0; i < 200; ++i) {
        velocity = std::min(0.6, velocity + 0.015);
        governed.sample.velocity.value.x = velocity;
        governed.sample.hip.value.x += 1e-3 * velocity;
        governed(along_x(3.0));
    }
    EXPECT_NE(governed.governor.state(), GovernorState::fault);
}

TEST(Trips, HaveNamesAndWordsOfTheirOwn)
{
    EXPECT_EQ(name_of(Trip::jump), "jump");
    EXPECT_EQ(what_happened({}), "");
    EXPECT_EQ(what_happened({Fault::overheat, Trip::device}), describe(Fault::overheat));
    EXPECT_NE(what_happened({Fault::timeout, Trip::loop}), describe(Fault::timeout));
    EXPECT_EQ(what_happened({Fault::timeout, Trip::silence}), describe(Fault::timeout));
}

} // namespace
} // namespace hapnet::device
