// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/chosen_device.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

device::Capabilities that_renders(double stiffness_max_n_per_m)
{
    device::Capabilities can;
    can.stiffness_max_n_per_m = stiffness_max_n_per_m;
    return can;
}

TEST(NoteOnStiffness, NameBothFiguresAndTheCureWhereTheSceneIsTooStiffAtTheHand)
{
    // Motion is doubled in the scene, so the stiffness there is four times as high.
    EXPECT_EQ(note_on_stiffness(that_renders(700.0), {.scale = 2.0}, 500.0),
              "contacts of 500 N/m in the scene, magnified 2.00 times, are 2000 N/m at the hand, "
              "and this device is said to render at most 700 N/m without buzzing: they are felt at "
              "no more than 35 % of their force. To feel all of it: a --mount-scale of at most "
              "1.18, or a --scene with softer contacts");
}

TEST(NoteOnStiffness, AreNoneWhereTheDeviceRendersAllOrNobodyKnowsOrThereIsNoForce)
{
    EXPECT_EQ(note_on_stiffness(that_renders(3000.0), {.scale = 2.0}, 500.0), "");
    EXPECT_EQ(note_on_stiffness(that_renders(500.0), {}, 500.0), "");
    EXPECT_EQ(note_on_stiffness(that_renders(0.0), {}, 5e5), "");
    device::Capabilities pointer = that_renders(1.0);
    pointer.axes_out = 0;
    EXPECT_EQ(note_on_stiffness(pointer, {}, 500.0), "");
}

TEST(NoteOnForceLimit, SaysWhichLimitHoldsWhenTheDeviceAllowsLess)
{
    EXPECT_EQ(note_on_force_limit(20.0, 3.3),
              "--force-limit 20N: the device allows at most 3.3N, and that limit holds");
    EXPECT_EQ(note_on_force_limit(3.3, 3.3), "");
    EXPECT_EQ(note_on_force_limit(1.0, 3.3), "");
}

TEST(DescribeOpenError, NamesTheDeviceAndTheReasonAndNothingElse)
{
    DeviceChoice choice;
    choice.name = "falcon:7";
    EXPECT_EQ(describe_open_error(choice, {device::Fault::in_use, "end the other program", 0}),
              "--device falcon:7: end the other program");
}

} // namespace
} // namespace hapnet::peer
