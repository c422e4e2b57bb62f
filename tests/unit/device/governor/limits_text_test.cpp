// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits_text.hpp"

#include "device/mechanisms.hpp"

#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

base::Result<GovernorLimits> read_limits(std::string_view text)
{
    return parse_limits(text, "limits", known_mechanisms);
}

void expect_equal(const GovernorLimits& a, const GovernorLimits& b)
{
    EXPECT_EQ(a.force_max_n, b.force_max_n);
    EXPECT_EQ(a.slew_max_n_per_s, b.slew_max_n_per_s);
    EXPECT_EQ(a.fade_out, b.fade_out);
    EXPECT_EQ(a.stall_max, b.stall_max);
    EXPECT_EQ(a.force_continuous_n, b.force_continuous_n);
    EXPECT_EQ(a.speed_max_m_per_s, b.speed_max_m_per_s);
    EXPECT_EQ(a.axes_out, b.axes_out);
    EXPECT_EQ(a.workspace_min, b.workspace_min);
    EXPECT_EQ(a.workspace_max, b.workspace_max);
    ASSERT_EQ(a.joints.has_value(), b.joints.has_value());
    if (a.joints) {
        EXPECT_EQ(a.joints->torque_max_nm, b.joints->torque_max_nm);
        EXPECT_EQ(a.joints->mechanism.jacobian, b.joints->mechanism.jacobian);
    }
}

TEST(LimitsText, ReadsBackToTheSameBitsWhetherThereAreLimitsOrNone)
{
    expect_equal(read_limits(print_limits({})).value(), {});
    GovernorLimits all;
    all.force_max_n = 1.0 / 3.0;
    all.force_continuous_n = 0.1 + 0.2;
    all.speed_max_m_per_s = 1.0;
    all.axes_out = 2;
    all.workspace_min = {{-1.0 / 7.0, -0.06, 0.0}};
    all.workspace_max = {{1e-9 / 3.0, 0.06, 0.07}};
    all.joints = JointLimits{omni::mechanism, omni::torque_max_nm};
    expect_equal(read_limits(print_limits(all)).value(), all);
    all.joints = JointLimits{falcon::mechanism, glm::dvec3{0.4096}};
    expect_equal(read_limits(print_limits(all)).value(), all);
}

TEST(LimitsText, NamesTheLineOfWhatItDoesNotKnow)
{
    const auto read = read_limits("force_max = \"3N\"\nforce_min = \"1N\"\n");
    ASSERT_FALSE(read.has_value());
    EXPECT_TRUE(read.error().message.starts_with("limits:2:")) << read.error().message;
}

/// The refusal of a line beside valid limits, or "" where it is accepted.
std::string refusal_of_limits(const std::string& line)
{
    const auto read = read_limits("force_max = \"3N\"\n" + line + "\n");
    return read ? "" : read.error().message;
}

TEST(LimitsText, RefusesWhatWouldMakeARuleMeaninglessAndSaysWhatIsPossible)
{
    struct Case {
        std::string key;
        std::string least;
        std::string most;
        std::vector<std::string> beyond;
    };
    for (const Case& c : {
             Case{"slew_max", "100N/s", "40000N/s", {"0N/s", "99N/s", "-1N/s", "40001N/s"}},
             Case{"slew_ramping", "1N/s", "40000N/s", {"0N/s", "40001N/s"}},
             Case{"fade_out", "1ms", "1s", {"0s", "999us", "1001ms"}},
             Case{"ramp_in", "100ms", "60s", {"0s", "99ms", "61s"}},
             Case{"tick", "100us", "10ms", {"0s", "99us", "11ms"}},
             Case{"stall_max", "2ms", "100ms", {"0s", "1ms", "101ms", "1h"}},
             Case{"fault_after", "20ms", "1s", {"0s", "1ms", "1001ms"}},
             Case{"heat_time", "1s", "600s", {"0s", "999ms", "601s"}},
             Case{"force_continuous", "1mN", "1000N", {"-1N", "1001N"}},
             Case{"speed_max", "1mm/s", "1000m/s", {"0m/s", "-1m/s", "1001m/s"}},
             Case{"energy.power_max", "1mW", "100W", {"0W", "-1W", "101W"}},
             Case{"energy.work_max", "1mJ", "100J", {"0J", "-1J", "101J"}},
         }) {
        const auto line = [&](const std::string& value) { return c.key + " = \"" + value + "\""; };
        EXPECT_EQ(refusal_of_limits(line(c.least)), "");
        EXPECT_EQ(refusal_of_limits(line(c.most)), "");
        for (const std::string& value : c.beyond) {
            const std::string said = refusal_of_limits(line(value));
            EXPECT_TRUE(said.starts_with("limits:2:")) << line(value) << " -> " << said;
        }
        for (const std::string value : {"nan", "inf", "1", "infs", "nanN", "infN/s"}) {
            EXPECT_NE(refusal_of_limits(c.key + " = " + value), "") << c.key << ' ' << value;
            EXPECT_NE(refusal_of_limits(line(value)), "") << c.key << ' ' << value;
        }
    }
    EXPECT_NE(refusal_of_limits("ramp_in = \"0s\"").find("100ms to 60s"), std::string::npos);
}

TEST(LimitsText, TakesNoForceAtAllAndAPeakBelowTheContinuousForce)
{
    EXPECT_TRUE(read_limits("force_max = \"0N\"\nforce_continuous = \"0N\"\n").has_value());
    EXPECT_EQ(refusal_of_limits("force_continuous = \"4N\""), "");
    for (const char* peak : {"-1N", "41N", "infN", "nanN"}) {
        EXPECT_FALSE(read_limits(std::string{"force_max = \""} + peak + "\"\n")) << peak;
    }
}

TEST(LimitsText, RefusesWhatContradictsItself)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"force_continuous = \"0N\"", "force_continuous is 0"},
        {"tick = \"5ms\"\nstall_max = \"5ms\"", "stall_max must be longer than tick"},
        {"fault_after = \"19ms\"", "fault_after must not be shorter than stall_max"},
        {"workspace_min.x = \"1mm\"\nworkspace_max.x = \"1mm\"", "workspace_min"},
        {"workspace_min.x = \"11m\"", "-10m to 10m"},
        {"axes_out = 1.5", "axes_out must be a whole number"},
        {"axes_out = 4.0", "3"},
        {"axes_out = -1.0", "3"},
        {"omni_torque_max.x = \"1N\"", "all of x, y and z"},
        {"falcon_torque_max.y = \"1N\"", "all of x, y and z"},
        {"omni_torque_max = { x = \"0N\", y = \"1N\", z = \"1N\" }", "100N"},
        {"omni_torque_max = { x = \"1N\", y = \"1N\", z = \"1N\" }\n"
         "falcon_torque_max = { x = \"1N\", y = \"1N\", z = \"1N\" }",
         "only one arm"},
        {"delta_torque_max.x = \"1N\"", "unknown key"}};
    for (const auto& [line, said] : cases) {
        const std::string refusal = refusal_of_limits(line);
        EXPECT_TRUE(refusal.starts_with("limits:")) << line << " -> " << refusal;
        EXPECT_NE(refusal.find(said), std::string::npos) << line << " -> " << refusal;
    }
}

TEST(GovernorLimits, OfEveryKindOfDeviceAreWithoutContradiction)
{
    EXPECT_TRUE(validate(GovernorLimits{}));
    EXPECT_TRUE(validate(limits_for({.axes_out = 0}, {})));
    EXPECT_TRUE(validate(limits_for({.force_max_n = 8.0}, {.force_max_n = 0.0})));
    EXPECT_FALSE(validate(GovernorLimits{.force_max_n = -1.0}));
    EXPECT_FALSE(validate(GovernorLimits{.fade_out = base::Duration{0}}));
    EXPECT_FALSE(validate(GovernorLimits{.heat_time = base::Duration{0}}));
    EXPECT_FALSE(validate(GovernorLimits{.slew_ramping_n_per_s = 0.0}));
    EXPECT_FALSE(validate(GovernorLimits{.speed_max_m_per_s = 0.0}));
}

} // namespace
} // namespace hapnet::device
