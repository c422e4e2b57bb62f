// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni/tracker.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::device::omni {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
const Counts in_inkwell{40, -7000, 300};
const Counts undocked = in_inkwell + Counts{100, 50, -50};

/// A tracker that gets a packet each millisecond.
struct Teller {
    Tracker tracker{};
    base::TimePoint now = start;

    const Sample& say(const Counts& counts, bool docked, std::uint32_t skipped = 0)
    {
        now += 1ms;
        tracker.on_report({counts, docked, 0, skipped}, now);
        return tracker.at(now);
    }
    void dock()
    {
        for (int ms = 0; ms < 60; ++ms) say(in_inkwell, true);
    }
};

TEST(OmniTracker, KnowsNothingOfWhereTheStylusIsUntilItHasRestedInItsInkwell)
{
    Teller omni;
    for (int ms = 0; ms < 100; ++ms) EXPECT_FALSE(omni.say(undocked, false).calibrated);
    EXPECT_EQ(omni.tracker.at(omni.now).fault, Fault::none);
    EXPECT_EQ(omni.tracker.at(omni.now).hip, base::Position{});
    EXPECT_EQ(omni.tracker.calibration(), CalibrationStep::dock_stylus);
    EXPECT_FALSE(omni.say(in_inkwell, true).calibrated);
    EXPECT_EQ(omni.tracker.calibration(), CalibrationStep::busy);
    for (int ms = 1; ms < 50; ++ms) EXPECT_FALSE(omni.say(in_inkwell, true).calibrated);
    EXPECT_TRUE(omni.say(in_inkwell, true).calibrated);
    EXPECT_EQ(omni.tracker.calibration(), CalibrationStep::done);
    EXPECT_TRUE(omni.tracker.at(omni.now).docked);
    EXPECT_FALSE(omni.tracker.may_push());
}

TEST(OmniTracker, IsNotCalibratedByAStylusThatTouchesItsInkwellOnlyInPassing)
{
    Teller omni;
    for (int ms = 0; ms < 200; ++ms) {
        EXPECT_FALSE(omni.say(in_inkwell + Counts{ms, 0, 0}, true).calibrated);
    }
}

TEST(OmniTracker, SaysWhereTheStylusIsFromTheInkwellsPose)
{
    Teller omni;
    omni.dock();
    const Sample& sample = omni.tracker.at(omni.now);
    EXPECT_LT(base::norm(sample.hip - position_of(inkwell_pose)), 1e-12);
    const Sample& moved = omni.say(undocked, false);
    const Joints joints{inkwell_pose.angles + radians_per_count * glm::dvec3{100, -50, -50}};
    EXPECT_LT(base::norm(moved.hip - position_of(joints)), 1e-12);
    EXPECT_FALSE(moved.docked);
    EXPECT_TRUE(omni.tracker.may_push());
}

TEST(OmniTracker, GivesTheSameSampleUntilThereIsANewWord)
{
    Teller omni;
    omni.dock();
    const auto sequence = omni.tracker.at(omni.now).sequence;
    EXPECT_EQ(omni.tracker.at(omni.now + 1ms).sequence, sequence);
    EXPECT_EQ(omni.say(in_inkwell, true).sequence, sequence + 1);
}

TEST(OmniTracker, CallsItATimeoutAfterTwentyMillisecondsOfSilenceAndNotBefore)
{
    Teller omni;
    omni.dock();
    EXPECT_EQ(omni.tracker.at(omni.now + 20ms - 1ns).fault, Fault::none);
    EXPECT_EQ(omni.tracker.at(omni.now + 20ms).fault, Fault::timeout);
    EXPECT_FALSE(omni.tracker.may_push());
    EXPECT_EQ(omni.say(in_inkwell, true).fault, Fault::none);
}

TEST(OmniTracker, CallsItBadCommunicationWhenAllThatItHearsIsNonsense)
{
    Teller omni;
    omni.dock();
    omni.tracker.on_nonsense();
    EXPECT_EQ(omni.tracker.at(omni.now + 19ms).fault, Fault::none);
    EXPECT_EQ(omni.tracker.at(omni.now + 20ms).fault, Fault::communication);
}

TEST(OmniTracker, LosesItsCalibrationByAJumpUntilTheStylusIsDockedAgain)
{
    Teller omni;
    omni.dock();
    omni.say(undocked, false);
    const Sample& jumped = omni.say(undocked + Counts{0, 0, 121}, false);
    EXPECT_EQ(jumped.fault, Fault::not_calibrated);
    EXPECT_FALSE(jumped.calibrated);
    EXPECT_EQ(omni.say(undocked + Counts{0, 0, 121}, false).fault, Fault::not_calibrated);
    omni.dock();
    EXPECT_EQ(omni.tracker.at(omni.now).fault, Fault::none);
    EXPECT_TRUE(omni.tracker.at(omni.now).calibrated);
}

TEST(OmniTracker, TakesNoFastHandForAJumpNorWhatHappenedWhileWordsWereLost)
{
    Teller omni;
    omni.dock();
    EXPECT_EQ(omni.say(in_inkwell + Counts{120, 120, -120}, false).fault, Fault::none);
    EXPECT_EQ(omni.say(in_inkwell + Counts{480, 120, -120}, false, 2).fault, Fault::none);
}

TEST(OmniTracker, LosesItsCalibrationWhereTheMechanismCannotBe)
{
    Teller omni;
    omni.dock();
    bool lost = false;
    for (int i = 1; i < 40 && !lost; ++i) {
        lost = omni.say(in_inkwell + Counts{100 * i, 0, 0}, false).fault == Fault::not_calibrated;
        // 0.98 rad of the waist and 0.15 to spare are 2698 counts.
        EXPECT_EQ(lost, 100 * i > 2698) << i;
    }
    EXPECT_TRUE(lost);
}

TEST(OmniTracker, TrustsNoPlaceAfterABreakUntilTheStylusHasRestedInItsInkwellSince)
{
    Teller omni;
    omni.dock();
    omni.say(undocked, false);
    omni.tracker.on_break();
    EXPECT_FALSE(omni.say(undocked, false).calibrated); // though the counts continue unchanged
    EXPECT_EQ(omni.tracker.at(omni.now).fault, Fault::not_calibrated);
    EXPECT_EQ(omni.tracker.calibration(), CalibrationStep::dock_stylus);
    omni.dock();
    omni.tracker.on_break(); // while it rests there, too
    for (int ms = 0; ms < 50; ++ms) EXPECT_FALSE(omni.say(in_inkwell, true).calibrated);
    EXPECT_TRUE(omni.say(in_inkwell, true).calibrated);
    EXPECT_EQ(omni.tracker.at(omni.now).fault, Fault::none);
}

TEST(OmniTracker, SaysForEverThatItHasGone)
{
    Teller omni;
    omni.dock();
    omni.tracker.on_gone();
    EXPECT_EQ(omni.say(in_inkwell, true).fault, Fault::disconnected);
    EXPECT_EQ(omni.tracker.calibration(), CalibrationStep::failed);
}

} // namespace
} // namespace hapnet::device::omni
