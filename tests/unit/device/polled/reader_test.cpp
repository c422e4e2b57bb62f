// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/polled/reader.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device::polled {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint first{1000s};

Report report_of(std::uint64_t cycle)
{
    Report report;
    report.cycle = cycle;
    report.hip = {{0.01, 0.02, 0.03}};
    report.velocity = {{0.1, 0.0, -0.1}};
    report.calibrated = true;
    return report;
}

TEST(PolledReader, GivesTheReportAndItsNumber)
{
    Reader reader;
    const Sample sample = reader.read(report_of(7), first);
    EXPECT_EQ(sample.hip, report_of(7).hip);
    EXPECT_EQ(sample.velocity, report_of(7).velocity);
    EXPECT_EQ(sample.sequence, 7U);
    EXPECT_TRUE(sample.calibrated);
    EXPECT_EQ(sample.fault, Fault::none);
}

TEST(PolledReader, IsNotCalibratedBeforeTheFirstReport)
{
    EXPECT_FALSE(Reader{}.read(Report{}, first).calibrated);
}

TEST(PolledReader, CallsASilenceATimeoutUntilTheNextReport)
{
    Reader reader;
    EXPECT_EQ(reader.read(report_of(1), first).fault, Fault::none);
    EXPECT_EQ(reader.read(report_of(1), first + Reader::silence_max).fault, Fault::none);
    EXPECT_EQ(reader.read(report_of(1), first + Reader::silence_max + 1ns).fault, Fault::timeout);
    EXPECT_EQ(reader.read(report_of(2), first + 1s).fault, Fault::none);
}

TEST(PolledReader, CallsAnEndlessWaitForTheFirstReportATimeout)
{
    Reader reader;
    EXPECT_EQ(reader.read(Report{}, first).fault, Fault::none);
    EXPECT_EQ(reader.read(Report{}, first + 21ms).fault, Fault::timeout);
}

TEST(PolledReader, KeepsTheLastPositionOfADeviceAtFault)
{
    Reader reader;
    EXPECT_EQ(reader.read(report_of(1), first).hip, report_of(1).hip);
    Report report = report_of(2);
    report.fault = Fault::disconnected;
    report.hip = {{9.0, 9.0, 9.0}};
    EXPECT_EQ(reader.read(report, first + 1ms).hip, report_of(1).hip);
    EXPECT_EQ(reader.read(report, first + 1ms).fault, Fault::disconnected);
}

TEST(PolledReader, CallsWhatIsNotFiniteAFaultAndKeepsTheLastPosition)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Reader reader;
    EXPECT_EQ(reader.read(report_of(1), first).fault, Fault::none);
    Report report = report_of(2);
    report.hip.value.y = nan;
    EXPECT_EQ(reader.read(report, first + 1ms).fault, Fault::communication);
    report = report_of(3);
    report.velocity.value.x = nan;
    EXPECT_EQ(reader.read(report, first + 2ms).fault, Fault::communication);
    EXPECT_EQ(reader.read(report, first + 2ms).hip, report_of(1).hip);
}

TEST(PolledReader, DebouncesButtons)
{
    Reader reader;
    Report report = report_of(1);
    report.buttons = 1;
    EXPECT_FALSE(reader.read(report, first).gripping);
    report.cycle = 2;
    EXPECT_TRUE(reader.read(report, first + Buttons::settling).gripping);
}

} // namespace
} // namespace hapnet::device::polled
