// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor.hpp"
#include "device/hid/pid_device.hpp"
#include "device/hid/pid_opening.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/device/ungoverned.hpp"
#include "tests/support/hid/memory_pid.hpp"

#include <gtest/gtest.h>
#include <tuple>

namespace hapnet::device::hid {
namespace {

using namespace std::chrono_literals;
using hid_double::Line;
using hid_double::MemoryOutbox;
using hid_double::MemoryWire;

class Pid : public ::testing::Test {
protected:
    void open(const Options& options)
    {
        const auto descriptor = parse_descriptor(hid_double::pid_descriptor()).value();
        PidParts parts{.identity = {.backend = "hid"},
                       .input = find_input(descriptor).value(),
                       .options = options,
                       .wire = std::make_unique<MemoryWire>(line_)};
        if (options.force_full_n) {
            const ForceLayout layout = find_force(descriptor).value();
            MemoryWire wire{line_};
            const Prepared prepared = prepare(wire, layout, 2).value();
            parts.outbox =
                std::make_unique<MemoryOutbox>(line_, PidSender{layout, prepared.blocks});
        }
        device_ = std::make_unique<PidDevice>(std::move(parts));
    }

    /// A millisecond of the device and of the host.
    Sample tick(const GovernedForce& force = {}, bool speaks = true)
    {
        now_ += 1ms;
        line_.pid.pass(0.001);
        if (speaks) line_.waiting.push_back(line_.pid.input_report());
        const Sample sample = device_->read(now_);
        device_->apply(force);
        return sample;
    }

    Line line_;
    std::unique_ptr<PidDevice> device_;
    base::TimePoint now_{1000s};
};

TEST_F(Pid, HasTwoAxesInAndOutOnceItsFullScaleIsKnownAndNeverMoreForceThanTheCap)
{
    open({.force_full_n = 8.0});
    const Capabilities& can = device_->capabilities();
    EXPECT_EQ(can.axes_in, 2);
    EXPECT_EQ(can.axes_out, 2);
    EXPECT_EQ(can.force_max_n, 3.3);
    EXPECT_FALSE(can.force_is_calibrated);
    EXPECT_EQ(can.workspace_max.x(), 0.08);
    EXPECT_EQ(can.workspace_max.z(), 0.0);
    EXPECT_EQ(can.resolution_m, 0.16 / 65534.0);
}

TEST_F(Pid, GoesAsFarAsItIsSaidToReach)
{
    open({.reach_m = 0.5});
    EXPECT_EQ(device_->capabilities().workspace_max.x(), 0.5);
    EXPECT_EQ(device_->capabilities().workspace_min.y(), -0.5);
    line_.waiting.push_back(
        hid_double::bytes_of({1, 0, 0, 0xff, 0x7f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(tick({}, false).hip.x(), 0.5);
}

TEST_F(Pid, IsOnlyReadWithoutItAndToldNothingAtAll)
{
    open({});
    EXPECT_EQ(device_->capabilities().axes_out, 0);
    EXPECT_EQ(device_->capabilities().force_max_n, 0.0);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(tick(ungoverned({{1.0, 0.0, 0.0}})).fault, Fault::none);
    device_->halt();
    device_.reset();
    EXPECT_TRUE(line_.pid.pushes().empty());
}

TEST_F(Pid, PushesTheHandTheWayTheForcePoints)
{
    open({.force_full_n = 8.0});
    // 1.2 N against a hand of 300 N/m, until it is at rest: 4 mm, to the resolution of the force, 8
    // N / 32767, and of the position.
    Sample sample;
    for (int i = 0; i < 2000; ++i) sample = tick(ungoverned({{1.2, 0.0, 0.0}}));
    EXPECT_NEAR(sample.hip.x(), 0.004, 5e-6);
    EXPECT_EQ(sample.hip.y(), 0.0);
    EXPECT_NEAR(sample.velocity.x(), 0.0, 1e-4);
    for (int i = 0; i < 2000; ++i) sample = tick(ungoverned({{0.0, 1.2, 0.0}}));
    EXPECT_NEAR(sample.hip.y(), 0.004, 5e-6);
    EXPECT_EQ(line_.pid.push().force_n[0], 0.0);
}

TEST_F(Pid, IsLimitedByItselfHoweverMuchItIsAskedFor)
{
    open({.force_full_n = 8.0});
    tick(ungoverned({{30.0, 40.0, 0.0}}));
    const auto push = line_.pid.push();
    EXPECT_NEAR(std::hypot(push.force_n[0], push.force_n[1]), 3.3, 8.0 / 32767);
    EXPECT_NEAR(push.force_n[0] / push.force_n[1], 0.75, 1e-3);
    tick(ungoverned({{std::nan(""), 0.0, 0.0}}));
    EXPECT_TRUE(line_.pid.push().is_zero());
}

TEST_F(Pid, PushesTheOtherWayWhereFullScaleIsNegative)
{
    open({.force_full_n = -8.0});
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    EXPECT_NEAR(line_.pid.push().force_n[0], -1.0, 8.0 / 32767);
}

TEST_F(Pid, LetsGoByItselfWhenTheHostHasDied)
{
    open({.force_full_n = 8.0});
    for (int i = 0; i < 50; ++i) tick(ungoverned({{1.0, 0.0, 0.0}}));
    EXPECT_FALSE(line_.pid.push().is_zero());
    line_.pid.pass(0.11);
    EXPECT_TRUE(line_.pid.push().is_zero());
}

TEST_F(Pid, HoldsAForceForAsLongAsItIsSaidAgain)
{
    open({.force_full_n = 8.0});
    for (int i = 0; i < 1000; ++i) {
        tick(ungoverned({{1.0, 0.0, 0.0}}));
        ASSERT_FALSE(line_.pid.push().is_zero()) << i;
    }
}

TEST_F(Pid, HaltStopsItAndTheNextForceEndsTheHalt)
{
    open({.force_full_n = 8.0});
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    device_->halt();
    EXPECT_TRUE(line_.pid.push().is_zero());
    EXPECT_FALSE(line_.pid.push().motors_on);
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    EXPECT_FALSE(line_.pid.push().is_zero());
}

TEST_F(Pid, IsLeftWithoutForceThreeTimesOverAndWithoutOurEffects)
{
    open({.force_full_n = 8.0});
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    device_.reset();
    const auto& pushes = line_.pid.pushes();
    ASSERT_GE(pushes.size(), 12U);
    for (std::size_t i = pushes.size() - 11; i < pushes.size(); ++i) {
        EXPECT_TRUE(pushes[i].is_zero() && !pushes[i].motors_on) << i;
    }
    EXPECT_EQ(line_.pid.places_taken(), 0U);
}

TEST_F(Pid, ThatIsSilentBecauseNothingMovesIsNotAtFaultAtRestNorUnderForce)
{
    open({.force_full_n = 8.0});
    const std::size_t questions = line_.questions;
    Governor governor{limits_for(device_->capabilities(), {})};
    tick();
    const auto play_silent = [&](bool permitted) {
        for (int i = 0; i < 2000; ++i) {
            now_ += 1ms;
            line_.pid.pass(0.001);
            const Sample sample = device_->read(now_);
            ASSERT_EQ(sample.fault, Fault::none) << i;
            device_->apply(governor.govern({{{1.0, 0.0, 0.0}}, permitted}, sample, now_));
        }
    };
    play_silent(false);
    EXPECT_EQ(governor.state(), GovernorState::ready);
    EXPECT_FALSE(line_.pid.push().motors_on);
    play_silent(true);
    EXPECT_EQ(governor.state(), GovernorState::active);
    EXPECT_NEAR(line_.pid.push().force_n[0], 1.0, 8.0 / 32767);
    EXPECT_EQ(governor.counters().silent, 0U);
    EXPECT_EQ(line_.questions, questions); // an open question would delay a stop
}

TEST_F(Pid, ThatSpeaksIsNotToldThatItRests)
{
    open({.force_full_n = 8.0});
    const std::size_t before = line_.pid.pushes().size();
    for (int i = 0; i < 100; ++i) tick();
    EXPECT_EQ(line_.pid.pushes().size(), before);
    for (int i = 0; i < 100; ++i) tick({}, false);
    // In the 8th tick, and in each 9th after it: the tick that sees it taken starts a new count.
    EXPECT_EQ(line_.pid.pushes().size(), before + 11);
}

TEST_F(Pid, ThatRestsAndThenTakesNothingIsAtFaultAfterTwentyMilliseconds)
{
    open({.force_full_n = 8.0});
    for (int i = 0; i < 100; ++i) tick({}, i == 0);
    line_.is_stuck = true;
    int until = 0;
    while (tick({}, false).fault == Fault::none && until < 100) ++until;
    EXPECT_LE(until, 20);
    EXPECT_EQ(tick({}, false).fault, Fault::timeout);
}

TEST_F(Pid, ThatTakesNothingIsAtFaultAfterTwentyMilliseconds)
{
    open({.force_full_n = 8.0});
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    line_.is_stuck = true;
    int until = 0;
    while (tick(ungoverned({{1.0, 0.0, 0.0}})).fault == Fault::none && until < 100) ++until;
    EXPECT_EQ(until, 20); // the first tick reads before it sends
    EXPECT_EQ(tick().fault, Fault::timeout);
    line_.is_stuck = false;
    tick(); // sends zero now
    EXPECT_EQ(tick().fault, Fault::none);
    EXPECT_FALSE(line_.pid.push().motors_on);
}

TEST_F(Pid, APauseOfTheHostIsNoSilenceOfTheDevice)
{
    open({.force_full_n = 8.0});
    tick();
    now_ += 500ms;
    EXPECT_EQ(tick({}, false).fault, Fault::none);
}

TEST_F(Pid, ThatRefusesReportsSaysSoUntilItTakesOne)
{
    open({.force_full_n = 8.0});
    line_.refuses = true;
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    EXPECT_EQ(tick(ungoverned({{1.0, 0.0, 0.0}})).fault, Fault::communication);
    line_.refuses = false;
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    EXPECT_EQ(tick().fault, Fault::none);
}

TEST_F(Pid, ThatTalksNonsenseIsNotBelieved)
{
    open({.force_full_n = 8.0});
    const Sample good = tick();
    const auto hears = [&](std::vector<std::byte> report) {
        line_.waiting.push_back(std::move(report));
        return tick({}, false);
    };
    EXPECT_EQ(hears(hid_double::bytes_of({1, 0, 0, 0, 0x80})).fault, Fault::communication);
    auto beyond = line_.pid.input_report();
    beyond[3] = std::byte{0x00};
    beyond[4] = std::byte{0x80}; // -32768, outside of the axis's range
    EXPECT_EQ(hears(beyond).fault, Fault::communication);
    EXPECT_EQ(hears(beyond).hip, good.hip);
    EXPECT_EQ(tick().fault, Fault::communication); // a bad one came since the last read
    EXPECT_EQ(tick().fault, Fault::none);
    EXPECT_EQ(hears(hid_double::bytes_of({2, 0x1f})).fault, Fault::none); // its state
}

TEST_F(Pid, ThatIsUnpluggedStaysSo)
{
    open({.force_full_n = 8.0});
    tick();
    line_.is_gone = true;
    EXPECT_EQ(tick().fault, Fault::disconnected);
    line_.is_gone = false;
    EXPECT_EQ(tick().fault, Fault::disconnected);
}

TEST_F(Pid, GripsByItsFirstButton)
{
    open({});
    line_.pid.press(true);
    for (int i = 0; i < 10; ++i) tick();
    EXPECT_TRUE(tick().gripping);
    EXPECT_EQ(tick().presses, 1);
    line_.pid.press(false);
    for (int i = 0; i < 10; ++i) tick();
    EXPECT_FALSE(tick().gripping);
}

TEST_F(Pid, TakesNoMemoryInATick)
{
    open({.force_full_n = 8.0});
    tick(ungoverned({{1.0, 0.0, 0.0}}));
    line_.is_stuck = true; // the double allocates memory for its notes
    for (int i = 0; i < 10; ++i) line_.waiting.push_back(line_.pid.input_report());
    const auto before = test::allocations();
    for (int i = 0; i < 10; ++i) {
        now_ += 1ms;
        std::ignore = device_->read(now_);
        device_->apply(ungoverned({{1.0, 0.0, 0.0}}));
    }
    device_->halt();
    EXPECT_EQ(test::allocations(), before);
    line_.is_stuck = false;
}

TEST_F(Pid, ReadsAllThatWaitsAtOnceAndNoMoreThanThat)
{
    open({});
    for (int i = 0; i < 100; ++i) line_.waiting.push_back(line_.pid.input_report());
    EXPECT_EQ(device_->read(now_).sequence, 64U);
    EXPECT_EQ(device_->read(now_).sequence, 100U);
}

} // namespace
} // namespace hapnet::device::hid
