// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/drive.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device::omni1394 {
namespace {

constexpr std::string_view whole_profile = "write_register_20010 = false\n"
                                           "[torque_nm_per_count]\n"
                                           "waist = 2e-4\n"
                                           "shoulder = -1e-4\n"
                                           "forearm = 1e-4\n"
                                           "[inkwell]\n"
                                           "waist = 0\n"
                                           "shoulder = \"0.25rad\"\n"
                                           "forearm = \"-20deg\"\n";

std::string complaint_about(std::string_view text)
{
    const auto profile = parse_profile(text, "omni.toml");
    return profile ? "" : profile.error().message;
}

TEST(OmniProfile, IsReadFromItsFile)
{
    const auto profile = parse_profile(whole_profile, "omni.toml");
    ASSERT_TRUE(profile) << profile.error().message;
    EXPECT_FALSE(profile->writes_dubious_register);
    EXPECT_EQ(profile->torque_nm_per_count, glm::dvec3(2e-4, -1e-4, 1e-4));
    EXPECT_EQ(profile->inkwell.angles.y, 0.25);
    EXPECT_NEAR(profile->inkwell.angles.z, -0.349065850398866, 1e-15);
    EXPECT_EQ(use_of(*profile, false), Use::measured);
}

TEST(OmniProfile, OfNothingLeavesTheDeviceReadOnly)
{
    const auto profile = parse_profile("", "omni.toml");
    ASSERT_TRUE(profile);
    EXPECT_TRUE(profile->writes_dubious_register);
    EXPECT_EQ(use_of(*profile, false), Use::read_only);
    EXPECT_EQ(use_of(*profile, true), Use::uncalibrated);
}

TEST(OmniProfile, NamesFileLineAndWhatWouldBeRight)
{
    EXPECT_EQ(complaint_about("\n[torque_nm_per_count]\nwaist = 1\n").substr(0, 15),
              "omni.toml:3:9: ");
    EXPECT_NE(complaint_about("[torque_nm_per_count]\nwaist = 0.0\n").find("1e-06 to 0.002"),
              std::string::npos);
    EXPECT_NE(complaint_about("[torque_nm_per_count]\nwaist = 1e-4\n").find("shoulder"),
              std::string::npos);
    EXPECT_EQ(complaint_about("[inkwell]\nwaist = \"2rad\"\n").substr(0, 14), "omni.toml:2:9:");
    EXPECT_EQ(complaint_about("write_register_20010 = 1\n").substr(0, 14), "omni.toml:1:24");
    EXPECT_NE(complaint_about("torque = 1\n"), "");
    EXPECT_NE(complaint_about("= ="), "");
}

TEST(OmniDrive, IsReadOnlyUntilSomeoneAsksForMore)
{
    const Drive drive{Use::read_only, {}};
    EXPECT_EQ(drive.motor_words(omni::torque_max_nm), glm::ivec3{0});
    Capabilities can;
    drive.describe(can);
    EXPECT_EQ(can.axes_out, 0);
    EXPECT_EQ(can.force_max_n, 0.0);
    EXPECT_FALSE(can.force_is_calibrated);
}

TEST(OmniDrive, UsesNoMoreThanAQuarterOfTheCountsUncalibrated)
{
    const Drive drive{Use::uncalibrated, {}};
    const glm::ivec3 words = drive.motor_words({10.0, -4.0, 0.1});
    // The direction is kept, by counts that have another size at the waist.
    EXPECT_EQ(words, glm::ivec3(511, std::lround(-0.4 * 0.16835 / 0.13335 * 511), 6));
    Capabilities can;
    drive.describe(can);
    EXPECT_NEAR(can.force_max_n, 3.3 / 4, 0.01);
    EXPECT_FALSE(can.force_is_calibrated);
    // 3.3 N on 0.133 m for 2047 counts.
    EXPECT_EQ(drive.motor_words({0.0, 3.3 * 0.13335 / 2047, 0.0}), glm::ivec3(0, 1, 0));
}

TEST(OmniDrive, UsesAllTheCountsByAMeasuredTable)
{
    const Drive drive{Use::measured, *parse_profile(whole_profile, "omni.toml")};
    EXPECT_EQ(drive.motor_words({0.02, 0.01, -0.005}), glm::ivec3(100, -100, -50));
    EXPECT_EQ(drive.motor_words({2.0, 0.0, 0.0}), glm::ivec3(2047, 0, 0));
    EXPECT_NEAR(drive.torque_max_nm().y, 0.2047, 1e-12);
    Capabilities can;
    drive.describe(can);
    EXPECT_EQ(can.force_max_n, 3.3);
    EXPECT_TRUE(can.force_is_calibrated);
    EXPECT_NEAR(can.joints->torque_max_nm.x, 0.4094, 1e-12);
}

TEST(OmniDrive, SaysZeroForWhatIsNotFinite)
{
    const Drive drive{Use::uncalibrated, {}};
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(drive.motor_words({nan, 0.1, 0.1}), glm::ivec3{0});
    EXPECT_EQ(drive.motor_words({0.1, -infinite, 0.1}), glm::ivec3{0});
}

} // namespace
} // namespace hapnet::device::omni1394
