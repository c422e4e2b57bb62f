// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/library.hpp"
#include "device/hdapi/stylus.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace hapnet::device::hdapi {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1000s};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Report report_of(std::uint64_t cycle)
{
    Report report;
    report.cycle = cycle;
    report.position_mm = {10.0, -20.0, 30.0};
    report.velocity_mm_per_s = {100.0, 0.0, -5.0};
    report.inkwell_switch = true;
    report.calibration = calibration::done;
    return report;
}

TEST(HdapiStylus, SpeaksMetresAndGrowsItsSequenceWithTheCycles)
{
    Stylus stylus{calibration::style_inkwell};
    const Sample sample = stylus.read(report_of(7), start);
    EXPECT_EQ(sample.hip.value, 1e-3 * glm::dvec3(10.0, -20.0, 30.0));
    EXPECT_EQ(sample.velocity.value, 1e-3 * glm::dvec3(100.0, 0.0, -5.0));
    EXPECT_EQ(sample.sequence, 7U);
    EXPECT_TRUE(sample.calibrated);
    EXPECT_FALSE(sample.docked);
}

TEST(HdapiStylus, IsDockedOnlyWhereThereIsAnInkwell)
{
    Report report = report_of(1);
    report.inkwell_switch = false;
    EXPECT_TRUE(Stylus{calibration::style_inkwell}.read(report, start).docked);
    EXPECT_FALSE(Stylus{calibration::style_automatic}.read(report, start).docked);
}

TEST(HdapiStylus, IsNotCalibratedBeforeItsFirstWord)
{
    EXPECT_FALSE(Stylus{calibration::style_inkwell}.read(Report{}, start).calibrated);
}

TEST(HdapiStylus, IsAtFaultWhereOnlyAnEncoderResetWouldCalibrateIt)
{
    Stylus stylus{calibration::style_encoder_reset};
    Report report = report_of(1);
    EXPECT_EQ(stylus.read(report, start).fault, Fault::none); // another program has calibrated it
    report.cycle = 2;
    report.calibration = calibration::needs_update;
    EXPECT_EQ(stylus.read(report, start + 1ms).fault, Fault::not_calibrated);
    EXPECT_FALSE(stylus.read(report, start + 1ms).calibrated);
}

TEST(HdapiStylus, TimesOutAfterTwentyMillisecondsOfSilenceAndNotANanosecondEarlier)
{
    Stylus stylus{calibration::style_inkwell};
    const Report report = report_of(1);
    EXPECT_EQ(stylus.read(report, start).fault, Fault::none);
    EXPECT_EQ(stylus.read(report, start + 20ms).fault, Fault::none);
    EXPECT_EQ(stylus.read(report, start + 20ms + 1ns).fault, Fault::timeout);
    EXPECT_EQ(stylus.read(report_of(2), start + 21ms).fault, Fault::none);
}

TEST(HdapiStylus, KeepsTheLastPlaceThatIsFiniteAndSaysThatTheNewOneIsNot)
{
    Stylus stylus{calibration::style_inkwell};
    std::ignore = stylus.read(report_of(1), start);
    Report report = report_of(2);
    report.position_mm[1] = nan;
    const Sample sample = stylus.read(report, start + 1ms);
    EXPECT_EQ(sample.fault, Fault::communication);
    EXPECT_EQ(sample.hip.y(), -0.020);
}

TEST(HdapiStylus, TellsAnErrorOnceEvenIfItReadsLate)
{
    Stylus stylus{calibration::style_inkwell};
    Report report = report_of(30);
    report.error = error::warm_motors;
    report.error_cycle = 12;
    EXPECT_EQ(stylus.read(report, start).fault, Fault::overheat);
    report.cycle = 31;
    EXPECT_EQ(stylus.read(report, start + 1ms).fault, Fault::none);
}

TEST(HdapiStylus, TakesALineThatFailsForAHundredCyclesForADeviceThatHasGone)
{
    Stylus stylus{calibration::style_inkwell};
    Report report = report_of(99);
    report.error = error::communication;
    report.error_cycle = 99;
    report.failures_in_a_row = 99;
    EXPECT_EQ(stylus.read(report, start).fault, Fault::communication);
    report.cycle = report.error_cycle = report.failures_in_a_row = 100;
    EXPECT_EQ(stylus.read(report, start + 1ms).fault, Fault::disconnected);
}

} // namespace
} // namespace hapnet::device::hdapi
