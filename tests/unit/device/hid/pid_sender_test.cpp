// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pid_sender.hpp"
#include "tests/unit/device/hid/pid_layouts.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::device::hid {
namespace {

using hid_double::bytes_of;

class Sender : public ::testing::Test {
protected:
    std::vector<std::vector<std::byte>> said(const Order& order)
    {
        std::vector<std::vector<std::byte>> reports;
        while (const auto report = sender_.next(order)) reports.push_back(bytes(*report));
        return reports;
    }

    PidSender sender_{layout_of({}), std::array<std::uint32_t, 2>{1, 2}};
    const std::vector<std::byte> stop_all_ = bytes_of({0x0c, 0x04});
    const std::vector<std::byte> disable_ = bytes_of({0x0c, 0x02});
    const std::vector<std::byte> no_right_ = bytes_of({0x05, 1, 0, 0});
    const std::vector<std::byte> no_away_ = bytes_of({0x05, 2, 0, 0});
};

TEST_F(Sender, IsSilentUntilItIsOrderedAnything) { EXPECT_TRUE(said({}).empty()); }

TEST_F(Sender, EnablesSetsBothForcesAndStartsThenOnlySetsThem)
{
    const Order first{.levels = {32767, -32767}, .motors_on = true, .number = 1};
    EXPECT_EQ(said(first), (std::vector{bytes_of({0x0c, 0x01}), bytes_of({0x05, 1, 0xff, 0x7f}),
                                        bytes_of({0x05, 2, 0x01, 0x80}), bytes_of({0x0a, 1, 1, 1}),
                                        bytes_of({0x0a, 2, 1, 1})}));
    EXPECT_TRUE(said(first).empty());
    const Order second{.levels = {0, 1}, .motors_on = true, .number = 2};
    EXPECT_EQ(said(second), (std::vector{no_right_, bytes_of({0x05, 2, 1, 0})}));
}

TEST_F(Sender, StartsTheEffectsAgainEveryTenthTick)
{
    std::size_t reports = 0;
    for (std::uint8_t tick = 1; tick <= 101; ++tick) {
        reports += said({.motors_on = true, .number = tick}).size();
    }
    EXPECT_EQ(reports, 5U + 100U * 2U + 10U * 2U);
}

TEST_F(Sender, StopsThreeTimesOverAndFirstOfAllBothAxesAtOnce)
{
    said({.levels = {99, 99}, .motors_on = true, .number = 1});
    const auto reports = said({});
    ASSERT_EQ(reports.size(), 12U);
    for (std::size_t i = 0; i < reports.size(); i += 4) {
        EXPECT_EQ(reports[i], stop_all_);
        EXPECT_EQ(reports[i + 1], disable_);
        EXPECT_EQ(reports[i + 2], no_right_);
        EXPECT_EQ(reports[i + 3], no_away_);
    }
    EXPECT_TRUE(said({}).empty());
    EXPECT_EQ(said({.stops = 1}).size(), 12U); // once more on demand
}

TEST_F(Sender, DropsAPushInTheMiddleOfItForAStop)
{
    const Order push{.levels = {99, 99}, .motors_on = true, .number = 1};
    ASSERT_TRUE(sender_.next(push).has_value());
    ASSERT_TRUE(sender_.next(push).has_value());
    EXPECT_EQ(bytes(sender_.next({}).value()), stop_all_);
}

TEST_F(Sender, EnablesAgainAfterAHaltThatTheNextForceOvertook)
{
    said({.motors_on = true, .number = 1});
    const auto reports = said({.motors_on = true, .stops = 1, .number = 2});
    EXPECT_EQ(reports.front(), bytes_of({0x0c, 0x01}));
    EXPECT_EQ(reports.size(), 5U);
}

TEST_F(Sender, GivesThePlacesBackAtTheEnd)
{
    const auto reports = said({.is_last = true, .stops = 1});
    ASSERT_EQ(reports.size(), 14U);
    EXPECT_EQ(reports[12], bytes_of({0x0b, 1}));
    EXPECT_EQ(reports[13], bytes_of({0x0b, 2}));
}

TEST_F(Sender, SaysToADeviceAtRestThatItRestsWhereSomebodyWantsToHearThatItLives)
{
    EXPECT_EQ(said({.probes = 1}), std::vector(1, disable_));
    EXPECT_TRUE(said({.probes = 1}).empty());
    said({.motors_on = true, .probes = 1, .number = 1});
    EXPECT_TRUE(said({.motors_on = true, .probes = 2, .number = 1}).empty()); // each tick shows it
    EXPECT_EQ(said({.probes = 3}).size(), 12U);                               // and so does a stop
}

TEST(Order, IsTheSameAfterItsWayThroughOneWord)
{
    const Order order{.levels = {-32767, 12345},
                      .motors_on = true,
                      .is_last = true,
                      .stops = 200,
                      .probes = 255,
                      .number = 129};
    EXPECT_EQ(unpacked_order(packed(order)), order);
    EXPECT_EQ(unpacked_order(packed({})), Order{});
}

} // namespace
} // namespace hapnet::device::hid
