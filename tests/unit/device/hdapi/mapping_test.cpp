// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/library.hpp"
#include "device/hdapi/mapping.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace hapnet::device::hdapi {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(HdapiMapping, KnowsEveryErrorOfTheInterface)
{
    const std::vector<std::pair<unsigned int, Fault>> all{
        {0x000, Fault::none},          {0x100, Fault::internal},      {0x101, Fault::internal},
        {0x102, Fault::internal},      {0x103, Fault::internal},      {0x104, Fault::internal},
        {0x200, Fault::overheat},      {0x201, Fault::over_force},    {0x202, Fault::over_force},
        {0x203, Fault::over_velocity}, {0x204, Fault::over_force},    {0x300, Fault::communication},
        {0x301, Fault::in_use},        {0x302, Fault::communication}, {0x303, Fault::communication},
        {0x304, Fault::timeout},       {0x400, Fault::internal},      {0x401, Fault::internal},
        {0x402, Fault::internal},      {0x500, Fault::internal},      {0x501, Fault::internal},
        {0x600, Fault::internal}};
    for (const auto& [code, fault] : all) EXPECT_EQ(fault_of(code), fault) << std::hex << code;
}

TEST(HdapiMapping, AsksForTheInkwellWhereOnlyAPersonCanHelp)
{
    EXPECT_EQ(calibration_step(0x5000, 4), CalibrationStep::done);
    EXPECT_EQ(calibration_step(0x5001, 4), CalibrationStep::dock_stylus);
    EXPECT_EQ(calibration_step(0x5001, 2), CalibrationStep::busy);
    EXPECT_EQ(calibration_step(0x5002, 4), CalibrationStep::dock_stylus);
    EXPECT_EQ(calibration_step(0, 4), CalibrationStep::failed);
    EXPECT_EQ(calibration_step(0x5001, 1), CalibrationStep::failed);
    EXPECT_EQ(preferred_style(7), 4);
    EXPECT_EQ(preferred_style(3), 2);
    EXPECT_EQ(preferred_style(1), 1);
}

TEST(HdapiMapping, SpeaksMetresAndDoubtsWhatIsNotSensible)
{
    const Capabilities can = capabilities_of({.workspace_mm = {-80, -60, -35, 80, 60, 35},
                                              .force_max_n = 3.3,
                                              .force_continuous_n = 0.88,
                                              .stiffness_max_n_per_mm = 0.5,
                                              .damping_max_ns_per_mm = 0.004,
                                              .velocity_limit_mm_per_s = 800.0,
                                              .update_rate_hz = 1000});
    EXPECT_DOUBLE_EQ(can.workspace_min.y(), -0.060);
    EXPECT_DOUBLE_EQ(can.workspace_max.x(), 0.080);
    EXPECT_DOUBLE_EQ(can.stiffness_max_n_per_m, 500.0);
    EXPECT_DOUBLE_EQ(can.damping_max_ns_per_m, 4.0);
    EXPECT_DOUBLE_EQ(can.speed_max_m_per_s, 0.8);
    EXPECT_EQ(can.pacing, Pacing::device);
    EXPECT_FALSE(can.has_holder);
    EXPECT_TRUE(capabilities_of({.calibration_styles = calibration::style_inkwell}).has_holder);

    const Capabilities doubtful = capabilities_of(
        {.workspace_mm = {not_a_number, 5, 0, 1, -5, 0}, .force_max_n = not_a_number});
    EXPECT_DOUBLE_EQ(doubtful.force_max_n, 0.88);
    EXPECT_LT(doubtful.workspace_min.y(), doubtful.workspace_max.y());
    EXPECT_LT(doubtful.workspace_min.x(), doubtful.workspace_max.x());

    // Above zero and finite, but not after conversion to metres.
    EXPECT_DOUBLE_EQ(capabilities_of({.velocity_limit_mm_per_s = 5e-324}).speed_max_m_per_s, 1.0);
    EXPECT_DOUBLE_EQ(capabilities_of({.stiffness_max_n_per_mm = 1e306}).stiffness_max_n_per_m, 400);

    // In metres, the scene would be magnified a thousand times, and a million times as stiff.
    const Capabilities tiny =
        capabilities_of({.workspace_mm = {-0.08, -0.06, -0.035, 0.08, 0.06, 0.035}});
    EXPECT_DOUBLE_EQ(tiny.workspace_max.x(), 0.080);
    EXPECT_DOUBLE_EQ(tiny.workspace_min.z(), -0.035);
}

TEST(HdapiMapping, ShowsNoTextOfTheLibraryThatATerminalOrJsonCannotBear)
{
    EXPECT_EQ(text_of(nullptr), "");
    EXPECT_EQ(text_of("PHANToM Omni"), "PHANToM Omni");
    EXPECT_EQ(text_of("Touch\xe9\x1b[2J\n"), "Touch??[2J?");
    EXPECT_EQ(text_of(std::string(1000, 'x').c_str()).size(), text_bytes_max);
}

} // namespace
} // namespace hapnet::device::hdapi
