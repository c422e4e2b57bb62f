// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/inverse3/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device::inverse3 {
namespace {

/// As the service's reference shows its first message, shortened.
constexpr std::string_view inventory = R"({
  "session_id": 7,
  "inverse3": [{
    "device_id": "049D",
    "config": {"type": "inverse3", "handedness": "right", "basis": {"permutation": "XYZ"}},
    "state": {
      "cursor_position": {"x": 0.01, "y": -0.12, "z": 0.15},
      "cursor_velocity": {"x": 0.1, "y": 0.2, "z": 0.3},
      "control_mode": "idle"},
    "status": {"calibrated": true, "in_use": false, "power_supply": true, "ready": true,
               "started": true}}],
  "wireless_verse_grip": [{"device_id": "61576",
    "state": {"buttons": {"a": true, "b": false, "c": true}, "hall": 1}}]})";

std::string with(const std::string& what, const std::string& instead)
{
    std::string text{inventory};
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), instead);
}

DeviceState device_in(const std::string& text)
{
    const auto state = parse_state(text);
    EXPECT_TRUE(state) << text;
    return state ? state->devices.at(0) : DeviceState{};
}

TEST(Inverse3Messages, ReadAnInventoryInOurFrame)
{
    const auto state = parse_state(inventory);
    ASSERT_TRUE(state) << state.error().message;
    ASSERT_EQ(state->devices.size(), 1U);
    const DeviceState& device = state->devices[0];
    EXPECT_EQ(device.id, "049D");
    EXPECT_EQ(device.hip.value, glm::dvec3(0.01, 0.15, 0.12)); // right, up, toward the user
    EXPECT_EQ(device.velocity.value, glm::dvec3(0.1, 0.3, -0.2));
    EXPECT_TRUE(device.calibrated && device.ready && device.powered && device.plain_axes);
    EXPECT_FALSE(device.in_use);
    EXPECT_EQ(state->buttons, 0b101);
}

TEST(Inverse3Messages, FindADeviceByItsIdentityOrTheFirst)
{
    const auto state = parse_state(inventory);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->find("049D"), state->find(""));
    EXPECT_EQ(state->find("049E"), nullptr);
    EXPECT_EQ(ServiceState{}.find(""), nullptr);
}

TEST(Inverse3Messages, TakeADeviceThatDoesNotSaySoForUncalibrated)
{
    EXPECT_FALSE(device_in(with(R"("calibrated": true)", R"("calibrated": 1)")).calibrated);
    EXPECT_FALSE(device_in(with(R"("status")", R"("statuses")")).calibrated);
}

TEST(Inverse3Messages, SayWhatKeepsADeviceFromBeingUsed)
{
    EXPECT_FALSE(device_in(with(R"("ready": true)", R"("ready": false)")).ready);
    EXPECT_FALSE(device_in(with(R"("started": true)", R"("started": false)")).ready);
    EXPECT_FALSE(device_in(with(R"("power_supply": true)", R"("power_supply": false)")).powered);
    EXPECT_TRUE(device_in(with(R"("in_use": false)", R"("in_use": true)")).in_use);
    EXPECT_FALSE(device_in(with("XYZ", "XZY")).plain_axes);
    EXPECT_TRUE(device_in(with(R"("config")", R"("settings")")).plain_axes); // only said once
}

TEST(Inverse3Messages, RefuseWhatIsNoPlace)
{
    for (const char* bad : {"null", "true", R"("0.01")", "1e999", "[]", "NaN"}) {
        EXPECT_FALSE(parse_state(with(R"("x": 0.01)", fmt::format(R"("x": {})", bad)))) << bad;
        EXPECT_FALSE(parse_state(with(R"("x": 0.1,)", fmt::format(R"("x": {},)", bad)))) << bad;
    }
    EXPECT_FALSE(parse_state(with(R"("x": 0.01, )", "")));
    EXPECT_FALSE(parse_state(with("cursor_velocity", "cursor_speed")));
}

TEST(Inverse3Messages, RefuseIdentitiesThatCouldNotBeSentBack)
{
    for (const std::string& bad :
         {std::string{}, std::string{R"(04\"9D)"}, std::string{R"(04\9D)"}, std::string{"04 9D"},
          std::string{R"(04\u00009D)"}, std::string(id_bytes_max + 1, 'a')}) {
        EXPECT_FALSE(parse_state(with("049D", bad))) << bad;
    }
    EXPECT_TRUE(parse_state(with("049D", std::string(id_bytes_max, 'a'))));
    EXPECT_FALSE(parse_state(with(R"("049D")", "1181")));
}

TEST(Inverse3Messages, RefuseWhatIsNoObjectOrTooMuch)
{
    for (const char* bad : {"", "[]", "7", "null", "{", R"({"inverse3":[{"device_id":)"}) {
        EXPECT_FALSE(parse_state(bad)) << bad;
    }
    EXPECT_FALSE(parse_state(R"({"a":")" + std::string(message_bytes_max, ' ') + R"("})"));
    nlohmann::json many = nlohmann::json::parse(inventory);
    const nlohmann::json one = many["inverse3"][0];
    for (std::size_t i = 0; i < devices_max; ++i) many["inverse3"].push_back(one);
    EXPECT_FALSE(parse_state(many.dump()));
    many["inverse3"].erase(0);
    EXPECT_TRUE(parse_state(many.dump()));
}

TEST(Inverse3Messages, ReadAServiceWithoutDevicesOrGrips)
{
    for (const char* text : {"{}", R"({"inverse3":[]})", R"({"inverse3":null,"verse_grip":7})"}) {
        const auto state = parse_state(text);
        ASSERT_TRUE(state) << text;
        EXPECT_TRUE(state->devices.empty());
        EXPECT_EQ(state->buttons, 0);
    }
}

TEST(Inverse3Messages, TellAForceInTheServicesFrame)
{
    const auto told = nlohmann::json::parse(force_message("049D", {{{0.1, 0.2, 0.3}}, true}));
    const auto& device = told.at("inverse3").at(0);
    EXPECT_EQ(device.at("device_id"), "049D");
    const auto& vector = device.at("commands").at("set_cursor_force").at("vector");
    EXPECT_EQ(vector.at("x"), 0.1);
    EXPECT_EQ(vector.at("y"), -0.3);
    EXPECT_EQ(vector.at("z"), 0.2);
}

TEST(Inverse3Messages, TellNoForceWithTheMotorsOff)
{
    const auto told = nlohmann::json::parse(force_message("a", {{{0.1, 0.2, 0.3}}, false}));
    for (const auto& part :
         told.at("inverse3").at(0).at("commands").at("set_cursor_force").at("vector")) {
        EXPECT_EQ(part, 0.0);
    }
}

TEST(Inverse3Reports, CallADeviceThatIsNotThereOrHasNoPowerGone)
{
    EXPECT_EQ(report_of(nullptr, 0).fault, Fault::disconnected);
    DeviceState device = device_in(std::string{inventory});
    device.powered = false;
    EXPECT_EQ(report_of(&device, 0).fault, Fault::disconnected);
}

TEST(Inverse3Reports, AreCalibratedOnlyOfADeviceThatIsReady)
{
    DeviceState device = device_in(std::string{inventory});
    EXPECT_TRUE(report_of(&device, 0).calibrated);
    device.ready = false;
    EXPECT_FALSE(report_of(&device, 0).calibrated);
}

} // namespace
} // namespace hapnet::device::inverse3
