// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/dhd/mapping.hpp"

#include <gtest/gtest.h>

namespace hapnet::device::dhd {
namespace {

Reading good_reading()
{
    Reading reading;
    reading.status[status::power] = 1;
    reading.status[status::connected] = 1;
    reading.status[status::force] = 1;
    return reading;
}

Reading failed_reading(int error)
{
    Reading reading;
    reading.result = failed;
    reading.error = error;
    return reading;
}

TEST(DhdMapping, TurnsTheLibrarysFrameIntoOursAndBack)
{
    // Toward the user, right, up.
    EXPECT_EQ(from_library({3.0, 1.0, 2.0}), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(to_library({1.0, 2.0, 3.0}), (std::array{3.0, 1.0, 2.0}));
}

TEST(DhdMapping, KnowsEveryErrorAsAFaultAndOnlyNoErrorAsNone)
{
    for (int code = 0; code < 40; ++code) {
        EXPECT_EQ(fault_of(code) == Fault::none, code == error::none) << code;
        EXPECT_FALSE(describe_error("4711", code).empty());
    }
    EXPECT_EQ(fault_of(error::timeout), Fault::timeout);
    EXPECT_EQ(fault_of(error::in_use), Fault::in_use);
}

TEST(DhdMapping, StatesNoMoreForceThanAnOmniBears)
{
    const Capabilities can = capabilities();
    EXPECT_EQ(can.force_max_n, 3.3);
    EXPECT_EQ(can.force_continuous_n, 0.88);
    EXPECT_LT(can.workspace_min.value.x, can.workspace_max.value.x);
}

TEST(DhdInterpreter, ReportsPositionVelocityAndButtonsInOurFrame)
{
    Reading reading = good_reading();
    reading.position = {0.03, 0.01, 0.02};
    reading.velocity = {0.3, 0.1, 0.2};
    reading.buttons = 1;
    const auto report = Interpreter{}.report_of(reading, false);
    EXPECT_EQ(report.hip.value, glm::dvec3(0.01, 0.02, 0.03));
    EXPECT_EQ(report.velocity.value, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(report.buttons, 1);
    EXPECT_TRUE(report.calibrated);
    EXPECT_EQ(report.fault, Fault::none);
}

TEST(DhdInterpreter, IsNotCalibratedWhileTheControllerAsksForIt)
{
    Reading reading = good_reading();
    reading.status[status::needs_calibration] = 1;
    EXPECT_FALSE(Interpreter{}.report_of(reading, false).calibrated);
}

TEST(DhdInterpreter, TakesADeviceForGoneAfterAHundredErrorsOfTheLineInARow)
{
    Interpreter interpreter;
    const Reading broken = failed_reading(error::communication);
    for (int i = 1; i < Interpreter::gone_after; ++i) {
        ASSERT_EQ(interpreter.report_of(broken, true).fault, Fault::communication);
    }
    EXPECT_EQ(interpreter.report_of(good_reading(), true).fault, Fault::none); // starts again
    for (int i = 1; i < Interpreter::gone_after; ++i) {
        ASSERT_EQ(interpreter.report_of(broken, true).fault, Fault::communication);
    }
    EXPECT_EQ(interpreter.report_of(broken, true).fault, Fault::disconnected);
}

TEST(DhdInterpreter, CallsAFailureWithoutACodeAFaultAllTheSame)
{
    EXPECT_EQ(Interpreter{}.report_of(failed_reading(error::none), false).fault, Fault::internal);
}

TEST(DhdInterpreter, SeesThatPowerOrCableIsGone)
{
    for (const std::size_t place : {status::power, status::connected}) {
        Reading reading = good_reading();
        reading.status[place] = 0;
        EXPECT_EQ(Interpreter{}.report_of(reading, true).fault, Fault::disconnected);
    }
}

TEST(DhdInterpreter, TellsMotorsThatTheControllerTookAwayForSpeedFromThoseThatWeSwitchedOff)
{
    Reading off = good_reading();
    off.status[status::force] = 0;
    off.status[status::force_off_cause] = force_off::velocity;
    Interpreter ours;
    EXPECT_EQ(ours.report_of(off, true).fault, Fault::none); // never were on
    EXPECT_EQ(ours.report_of(good_reading(), true).fault, Fault::none);
    EXPECT_EQ(ours.report_of(off, false).fault, Fault::none);
    Interpreter its;
    EXPECT_EQ(its.report_of(good_reading(), true).fault, Fault::none);
    EXPECT_EQ(its.report_of(off, true).fault, Fault::over_velocity);
}

} // namespace
} // namespace hapnet::device::dhd
