// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/spacemouse.hpp"
#include "tests/support/hid/memory_pid.hpp"

#include <gtest/gtest.h>

namespace hapnet::device::hid {
namespace {

using namespace std::chrono_literals;
using hid_double::bytes_of;

class Cap : public ::testing::Test {
protected:
    Sample tick()
    {
        now_ += 1ms;
        return mouse_.read(now_);
    }
    Sample hears(const std::vector<unsigned>& report)
    {
        line_.waiting.push_back(bytes_of(report));
        return tick();
    }

    hid_double::Line line_;
    SpaceMouse mouse_{{.backend = "hid"}, std::make_unique<hid_double::MemoryWire>(line_)};
    base::TimePoint now_{1000s};
};

TEST_F(Cap, HasThreeAxesInAndNoMotors)
{
    EXPECT_EQ(mouse_.capabilities().axes_in, 3);
    EXPECT_EQ(mouse_.capabilities().axes_out, 0);
    EXPECT_EQ(mouse_.capabilities().force_max_n, 0.0);
}

TEST_F(Cap, PushedToTheFullMovesAtATenthOfAMetrePerSecondTheWayItIsPushed)
{
    hears({1, 0x5e, 0x01, 0, 0, 0, 0}); // 350: right
    for (int i = 0; i < 100; ++i) tick();
    EXPECT_NEAR(tick().hip.x(), 0.0101, 1e-12);
    EXPECT_NEAR(tick().velocity.x(), 0.1, 1e-12);
    // -350 along z, which points down, and 175 toward the user.
    hears({1, 0, 0, 0xaf, 0x00, 0xa2, 0xfe});
    const Sample before = tick();
    const Sample after = tick();
    EXPECT_NEAR((after.hip - before.hip).y(), 0.0001, 1e-12);
    EXPECT_NEAR((after.hip - before.hip).z(), 0.00005, 1e-12);
    EXPECT_EQ(after.hip.x(), before.hip.x());
}

TEST_F(Cap, ThatReportsTranslationAndRotationInOneIsUnderstoodToo)
{
    hears({1, 0x5e, 0x01, 0, 0, 0, 0, 0xff, 0x7f, 0, 0, 0, 0});
    EXPECT_NEAR(tick().velocity.x(), 0.1, 1e-12);
}

TEST_F(Cap, AtRestOrTurnedMovesNothing)
{
    hears({1, 9, 0, 0xf7, 0xff, 0, 0});
    hears({2, 0x5e, 0x01, 0x5e, 0x01, 0, 0});
    for (int i = 0; i < 100; ++i) tick();
    EXPECT_EQ(tick().hip, base::Position{});
}

TEST_F(Cap, StaysInsideItsWorkspace)
{
    for (int i = 0; i < 2000; ++i) {
        const Sample sample = hears({1, 0x5e, 0x01, 0x5e, 0x01, 0x5e, 0x01});
        ASSERT_LE(sample.hip.x(), 0.08);
        ASSERT_GE(sample.hip.y(), -0.06);
        ASSERT_LE(sample.hip.z(), 0.035);
    }
    EXPECT_EQ(tick().hip, (base::Position{{0.08, -0.06, 0.035}}));
    EXPECT_EQ(tick().velocity, base::Velocity{});
}

TEST_F(Cap, ThatSaysItNoMoreCountsAsLetGoAfterTwoHundredMilliseconds)
{
    hears({1, 0x5e, 0x01, 0, 0, 0, 0});
    for (int i = 0; i < 1000; ++i) tick();
    EXPECT_NEAR(tick().hip.x(), 0.0201, 1e-12);
    EXPECT_EQ(tick().fault, Fault::none); // silence is not a fault
}

TEST_F(Cap, DoesNotJumpWhenTheHostPauses)
{
    hears({1, 0x5e, 0x01, 0, 0, 0, 0});
    now_ += 10s;
    EXPECT_NEAR(tick().hip.x(), 0.002, 1e-12);
}

TEST_F(Cap, GripsByItsLeftButton)
{
    hears({3, 1, 0});
    for (int i = 0; i < 10; ++i) tick();
    EXPECT_TRUE(tick().gripping);
    hears({3, 2, 0});
    for (int i = 0; i < 10; ++i) tick();
    EXPECT_FALSE(tick().gripping);
    EXPECT_EQ(tick().buttons, 2);
}

TEST_F(Cap, ThatTalksNonsenseStopsAndSaysSo)
{
    hears({1, 0x5e, 0x01, 0, 0, 0, 0});
    EXPECT_EQ(hears({1, 0x5e}).fault, Fault::communication);
    EXPECT_EQ(tick().velocity, base::Velocity{});
    EXPECT_EQ(hears({1, 0xff, 0x7f, 0, 0, 0, 0}).fault, Fault::communication);
    EXPECT_EQ(hears({3}).fault, Fault::communication);
    EXPECT_EQ(hears({23, 5}).fault, Fault::none); // its battery
}

TEST_F(Cap, ThatIsUnpluggedSaysSo)
{
    line_.is_gone = true;
    EXPECT_EQ(tick().fault, Fault::disconnected);
}

TEST(SpaceMouseName, IsGivenOnlyToThose)
{
    EXPECT_EQ(spacemouse_name(0x046d, 0xc626), "SpaceNavigator");
    EXPECT_EQ(spacemouse_name(0x256f, 0xc635), "SpaceMouse Compact");
    EXPECT_EQ(spacemouse_name(0x046d, 0xc62a), "");
}

} // namespace
} // namespace hapnet::device::hid
