// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/buttons.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint switched{1h};

TEST(Buttons, CountAsPressedOnceTheyHaveSaidSoForFiveMilliseconds)
{
    Buttons buttons;
    buttons.update(1, switched);
    buttons.update(1, switched + 5ms - 1ns);
    EXPECT_EQ(buttons.held(), 0);
    EXPECT_EQ(buttons.presses(), 0);
    buttons.update(1, switched + 5ms);
    EXPECT_EQ(buttons.held(), 1);
    EXPECT_EQ(buttons.presses(), 1);
}

TEST(Buttons, DoNotCountWhatBounces)
{
    Buttons buttons;
    for (int ms = 0; ms < 40; ++ms) {
        buttons.update(ms % 4 == 3 ? 0 : 1, switched + ms * 1ms);
        ASSERT_EQ(buttons.held(), 0);
    }
}

TEST(Buttons, StayPressedWhileTheyBounceOpen)
{
    Buttons buttons;
    buttons.update(1, switched);
    buttons.update(1, switched + 5ms);
    buttons.update(0, switched + 6ms);
    buttons.update(1, switched + 9ms);
    buttons.update(0, switched + 10ms);
    buttons.update(0, switched + 14ms);
    EXPECT_EQ(buttons.held(), 1);
    buttons.update(0, switched + 15ms);
    EXPECT_EQ(buttons.held(), 0);
    EXPECT_EQ(buttons.presses(), 1);
}

TEST(Buttons, AreDebouncedEachOnItsOwnAndOnlyThePrimaryOneIsCounted)
{
    Buttons buttons;
    buttons.update(0b10, switched);
    buttons.update(0b11, switched + 3ms);
    buttons.update(0b11, switched + 5ms);
    EXPECT_EQ(buttons.held(), 0b10);
    EXPECT_EQ(buttons.presses(), 0);
    buttons.update(0b11, switched + 8ms);
    EXPECT_EQ(buttons.held(), 0b11);
    Sample sample;
    buttons.tell(sample);
    EXPECT_EQ(sample.buttons, 0b11);
    EXPECT_TRUE(sample.gripping);
    EXPECT_EQ(sample.presses, 1);
}

} // namespace
} // namespace hapnet::device
