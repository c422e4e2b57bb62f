// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/device_state/state.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer::device_state {
namespace {

using namespace std::chrono_literals;

constexpr double day_s = 24.0 * 3600;
constexpr double now_s = 1.8e9;
constexpr Moment moment{now_s, now_s - day_s};

TEST(DeviceState, AsksForASelfTestThatIsMissingOldOrOfTheFuture)
{
    EXPECT_EQ(why_untested({}, now_s), "it has not passed a self-test on this machine");
    EXPECT_EQ(why_untested({.self_test_passed_s = now_s}, now_s), "");
    EXPECT_EQ(why_untested({.self_test_passed_s = now_s - 30 * day_s}, now_s), "");
    EXPECT_EQ(why_untested({.self_test_passed_s = now_s - 30 * day_s - 1}, now_s),
              "its self-test is older than 30 days");
    EXPECT_EQ(why_untested({.self_test_passed_s = now_s + 1}, now_s),
              "its self-test is dated in the future: check the clock");
}

TEST(DeviceState, LetsMotorsCoolDownSinceTheirHeatWasNoted)
{
    const auto heat = [](double since_s) {
        return heat_at_start({.heat = DeviceState::Heat{1.0, now_s - since_s}}, moment, 15s);
    };
    EXPECT_DOUBLE_EQ(heat(0.0), 1.0);
    EXPECT_NEAR(heat(15.0), 0.367879, 1e-6); // 1/e
    EXPECT_LT(heat(600.0), 1e-12);
}

TEST(DeviceState, TakesMotorsOfWhichItKnowsNothingForWarm)
{
    EXPECT_EQ(heat_at_start({}, moment, 15s), unknown_heat);
    EXPECT_EQ(heat_at_start({.heat = DeviceState::Heat{0.0, now_s + 1}}, moment, 15s),
              unknown_heat);
    EXPECT_EQ(heat_at_start({.heat = DeviceState::Heat{0.0, now_s - day_s - 1}}, moment, 15s),
              unknown_heat);
}

TEST(DeviceState, ReadsBackAsItWasWritten)
{
    const DeviceState all{.self_test_passed_s = now_s, .heat = DeviceState::Heat{0.25, now_s + 7}};
    for (const DeviceState& state : {DeviceState{}, all, DeviceState{.self_test_passed_s = 1.0}}) {
        const auto again = parse(to_text(state));
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->self_test_passed_s, state.self_test_passed_s);
        ASSERT_EQ(again->heat.has_value(), state.heat.has_value());
        if (!state.heat) continue;
        EXPECT_EQ(again->heat->heat, state.heat->heat);
        EXPECT_EQ(again->heat->at_s, state.heat->at_s);
    }
}

TEST(DeviceState, IsNotReadFromAnythingElse)
{
    const std::string good = to_text({.heat = DeviceState::Heat{0.25, now_s}});
    const auto with = [&good](std::string_view from, std::string_view to) {
        std::string text = good;
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    };
    for (const std::string& text :
         {std::string{}, std::string{"[]"}, good.substr(0, good.size() / 2),
          with("\"version\": 1", "\"version\": 2"), with("hapnet-device-state", "x"),
          with("0.25", "-1"), with("0.25", "\"0.25\""), with("0.25", "1e999"),
          with("heat_unix_s", "heat_at")}) {
        EXPECT_FALSE(parse(text)) << text;
    }
    const auto hot = parse(with("0.25", "101"));
    ASSERT_TRUE(hot);
    EXPECT_FALSE(hot->heat) << "no heat that a governor would take";
}

TEST(DeviceState, HasAFileOfItsOwnForEveryDevice)
{
    EXPECT_EQ(file_name({.backend = "falcon", .serial = "A1-b_2"}, "x"), "falcon-A1-b_2.json");
    EXPECT_EQ(file_name({.backend = "hid"}, "/dev/hidraw0"), "hid-%2Fdev%2Fhidraw0.json");
    EXPECT_EQ(file_name({.backend = "hdapi", .serial = "Default Device"}, ""),
              "hdapi-Default%20Device.json");
    EXPECT_EQ(file_name({.backend = "hdapi", .serial = "../x"}, ""), "hdapi-%2E%2E%2Fx.json");
    EXPECT_EQ(file_name({.backend = "hdapi"}, ""), "hdapi-only.json");
}

} // namespace
} // namespace hapnet::peer::device_state
