// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/device_cycle.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::device::hdapi {
namespace {

/// The calls of a fake library. C functions have no other place for them.
struct Told {
    unsigned int calibration = calibration::done;
    int updates = 0;
    bool force_output = true;
    std::array<double, 3> force{};
};
Told told;

Functions functions_of_told()
{
    Functions it;
    it.make_current_device = [](Handle) {};
    it.begin_frame = [](Handle) {};
    it.end_frame = [](Handle) {};
    it.enable = [](unsigned int) { told.force_output = true; };
    it.disable = [](unsigned int) { told.force_output = false; };
    it.get_booleans = [](unsigned int, unsigned char* value) { *value = 1; };
    it.get_integers = [](unsigned int, int* value) { *value = 0; };
    it.get_doubles = [](unsigned int, double* values) { std::fill_n(values, 3, 0.0); };
    it.set_doubles = [](unsigned int, const double* v) { std::copy_n(v, 3, told.force.begin()); };
    it.check_calibration = [] { return told.calibration; };
    it.update_calibration = [](unsigned int) { ++told.updates; };
    return it;
}

constexpr Command push{{1.0, 0.0, 0.0}, true};

class HdapiCycle : public ::testing::Test {
protected:
    HdapiCycle() { told = {}; }
    const Functions functions_ = functions_of_told();
};

} // namespace

TEST_F(HdapiCycle, UpdatesACalibrationThatNeedsItButNeverResetsEncoders)
{
    told.calibration = calibration::needs_update;
    for (const int style : {calibration::style_inkwell, calibration::style_automatic}) {
        told.updates = 0;
        DeviceCycle{functions_, 0, style}.begin();
        EXPECT_EQ(told.updates, 1);
    }
    told.updates = 0;
    DeviceCycle reset{functions_, 0, calibration::style_encoder_reset};
    EXPECT_EQ(reset.begin().calibration, calibration::needs_update);
    EXPECT_EQ(told.updates, 0);
}

TEST_F(HdapiCycle, SendsNoForceInAFrameThatBeginsUncalibrated)
{
    DeviceCycle cycle{functions_, 0, calibration::style_inkwell};
    cycle.begin();
    EXPECT_FALSE(told.force_output);
    cycle.end(push, true);
    EXPECT_TRUE(told.force_output);
    EXPECT_EQ(told.force, push.force_n);
    told.calibration = calibration::needs_person;
    cycle.begin();
    cycle.end(push, true);
    EXPECT_FALSE(told.force_output);
    EXPECT_EQ(told.force, (std::array<double, 3>{}));
}

TEST_F(HdapiCycle, RepeatsACommandForTwentyCyclesAndNoLonger)
{
    DeviceCycle cycle{functions_, 0, calibration::style_inkwell};
    std::uint64_t pushed = 0;
    for (int i = 0; i < 100; ++i) {
        cycle.begin();
        cycle.end(push, i == 0);
        if (told.force_output) ++pushed;
    }
    EXPECT_EQ(pushed, DeviceCycle::stale_after_cycles);
    EXPECT_EQ(cycle.silent_frames(), 100 - DeviceCycle::stale_after_cycles);
}

TEST_F(HdapiCycle, CountsAnErrorToTheCycleInWhichItCame)
{
    DeviceCycle cycle{functions_, 0, calibration::style_inkwell};
    cycle.begin();
    cycle.end({}, true);
    cycle.note(error::communication);
    const Report& report = cycle.begin();
    EXPECT_EQ(report.error, error::communication);
    EXPECT_EQ(report.error_cycle, 1U);
    EXPECT_EQ(report.failures_in_a_row, 1U);
    cycle.end({}, true);
    cycle.begin();
    EXPECT_EQ(report.failures_in_a_row, 0U);
}

} // namespace hapnet::device::hdapi
