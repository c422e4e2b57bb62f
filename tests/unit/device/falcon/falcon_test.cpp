// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/falcon.hpp"

#include "device/falcon/kinematics.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>

namespace hapnet::device::falcon {
namespace {

using namespace std::chrono_literals;

/// The other end of the wire, in memory. Outlives the link.
struct Wire {
    std::vector<Command> heard;
    std::vector<std::byte> to_host;
    int sent_now = 0;
    bool takes = true;
    bool is_gone = false;

    void say(const Report& report)
    {
        const Packet packet = encode(report);
        to_host.insert(to_host.end(), packet.begin(), packet.end());
    }
};

class WireLink final : public Link {
public:
    explicit WireLink(Wire& wire) : wire_{wire} {}
    bool send(const Packet& packet) noexcept override
    {
        if (wire_.is_gone || !wire_.takes) return false;
        wire_.heard.push_back(decode_command(packet).value());
        return true;
    }
    std::span<const std::byte> receive(Wait /*wait*/) noexcept override
    {
        inbox_ = std::exchange(wire_.to_host, {});
        return inbox_;
    }
    bool is_gone() const noexcept override { return wire_.is_gone; }
    void interrupt(const Packet& packet) noexcept override { std::ignore = send(packet); }
    void send_now(const Packet& packet) noexcept override
    {
        if (send(packet)) ++wire_.sent_now;
    }

private:
    Wire& wire_;
    std::vector<std::byte> inbox_;
};

/// A Falcon on that wire, read and told a force once a millisecond.
class FalconTest : public ::testing::Test {
protected:
    Sample tick(const GovernedForce& force = {})
    {
        now_ += 1ms;
        const Sample sample = falcon_->read(now_);
        falcon_->apply(force);
        return sample;
    }
    Sample tick_with(const Report& report, const GovernedForce& force = {})
    {
        wire_.say(report);
        return tick(force);
    }
    static Report homed_at(const base::Position& grip)
    {
        return {.encoders = encoders_at(inverse(grip).value()), .legs_homed = all_legs};
    }

    Wire wire_;
    base::TimePoint now_{1000s};
    std::unique_ptr<Falcon> falcon_ =
        std::make_unique<Falcon>(std::make_unique<WireLink>(wire_), "123");
};

const GovernedForce one_newton = ungoverned({{1.0, 0.0, 0.0}});

TEST_F(FalconTest, SaysThatItWasNeverRunOnThePhysicalDevice)
{
    EXPECT_EQ(falcon_->identity().backend, "falcon");
    EXPECT_EQ(falcon_->identity().serial, "123");
    EXPECT_EQ(falcon_->identity().note, never_run);
    EXPECT_FALSE(falcon_->capabilities().force_is_calibrated);
}

TEST_F(FalconTest, AsksOnceAndWaitsForTheAnswer)
{
    for (int i = 0; i < 5; ++i) tick();
    EXPECT_EQ(wire_.heard.size(), 1U);
    tick_with(Report{});
    EXPECT_EQ(wire_.heard.size(), 2U);
}

TEST_F(FalconTest, AsksAgainWhenTheAnswerWasLost)
{
    for (int i = 0; i < 11; ++i) tick();
    EXPECT_EQ(wire_.heard.size(), 2U); // at 0 ms and at 10 ms
}

TEST_F(FalconTest, EndsAPushWithoutWaitingForTheAnswer)
{
    tick_with(homed_at({}));
    tick_with(homed_at({}), one_newton);
    tick(one_newton);
    ASSERT_EQ(wire_.heard.size(), 2U);
    ASSERT_NE(wire_.heard.back().motors, Counts{});
    tick();
    ASSERT_EQ(wire_.heard.size(), 3U);
    EXPECT_EQ(wire_.heard.back().motors, Counts{});
}

TEST_F(FalconTest, GivesThePlaceOfItsEncodersOnceItsLegsAreHomed)
{
    const base::Position grip{{0.01, -0.02, 0.015}};
    Report report = homed_at(grip);
    report.legs_homed = 0x5;
    EXPECT_FALSE(tick_with(report).calibrated);
    EXPECT_EQ(tick_with(report).hip, base::Position{});
    const Sample sample = tick_with(homed_at(grip));
    EXPECT_TRUE(sample.calibrated);
    EXPECT_LT(base::norm(sample.hip - grip), 0.0001); // two counts
    EXPECT_EQ(sample.sequence, 3U);
    EXPECT_EQ(tick().sequence, 3U); // nothing new
}

TEST_F(FalconTest, IsAskedToHomeUntilItIs)
{
    tick();
    EXPECT_FALSE(wire_.heard.back().home);
    EXPECT_EQ(falcon_->calibrate(now_), CalibrationStep::sweep_joints);
    tick_with(Report{});
    EXPECT_TRUE(wire_.heard.back().home);
    EXPECT_EQ(wire_.heard.back().lights, Lights::red);
    tick_with(homed_at({}));
    EXPECT_FALSE(wire_.heard.back().home);
    EXPECT_EQ(wire_.heard.back().lights, Lights::green);
    EXPECT_EQ(falcon_->calibrate(now_), CalibrationStep::done);
}

TEST_F(FalconTest, TellsItsMotorsNothingBeforeItsLegsAreHomed)
{
    tick(one_newton);
    tick_with(Report{.legs_homed = 0x3}, one_newton);
    for (const Command& command : wire_.heard) EXPECT_EQ(command.motors, Counts{});
}

TEST_F(FalconTest, TurnsAForceIntoTorquesByTheTransposedJacobian)
{
    const base::Force force{{0.5, -1.0, 2.0}};
    const Sample sample = tick_with(homed_at({{0.01, 0.0, 0.0}}), ungoverned(force));
    const glm::dvec3 torque = glm::transpose(jacobian(sample.hip)) * force.value;
    for (int leg = 0; leg < 3; ++leg) {
        EXPECT_NEAR(wire_.heard.back().motors[static_cast<std::size_t>(leg)], -1e4 * torque[leg],
                    0.5);
    }
    // Toward the user is away from the legs' plane: all legs go to larger angles, by less than 0.
    tick_with(homed_at({}), ungoverned({{0.0, 0.0, 1.0}}));
    for (const std::int16_t count : wire_.heard.back().motors) EXPECT_LT(count, 0);
}

TEST_F(FalconTest, KeepsTheDirectionOfAForceThatIsTooMuchForItsMotors)
{
    tick_with(homed_at({{0.02, 0.01, 0.0}}), ungoverned({{30.0, 20.0, -10.0}}));
    const Counts full = wire_.heard.back().motors;
    tick_with(homed_at({{0.02, 0.01, 0.0}}), ungoverned({{3.0, 2.0, -1.0}}));
    const Counts part = wire_.heard.back().motors;
    const auto size = [](std::int16_t count) { return std::abs(int{count}); };
    const auto most = [&](const Counts& counts) {
        return std::max({size(counts[0]), size(counts[1]), size(counts[2])});
    };
    EXPECT_EQ(most(full), motor_max);
    for (std::size_t leg = 0; leg < 3; ++leg) {
        // Both are rounded to a count.
        EXPECT_NEAR(full[leg], part[leg] * double{motor_max} / most(part), 3.0);
    }
}

TEST_F(FalconTest, SilenceForMoreThan20MillisecondsIsATimeout)
{
    tick_with(homed_at({}));
    for (int i = 0; i < 20; ++i) EXPECT_EQ(tick().fault, Fault::none);
    EXPECT_EQ(tick().fault, Fault::timeout);
    EXPECT_EQ(tick_with(homed_at({})).fault, Fault::none); // others latch faults
}

TEST_F(FalconTest, AHostThatWasAwayTakesItForNoSilence)
{
    tick_with(homed_at({}));
    now_ += 500ms;
    EXPECT_EQ(tick().fault, Fault::none);
    EXPECT_EQ(tick_with(homed_at({})).fault, Fault::none);
}

TEST_F(FalconTest, NonsenseForMoreThan20MillisecondsIsAFaultOfTheLine)
{
    tick_with(homed_at({}));
    Sample sample;
    for (int i = 0; i < 21; ++i) {
        wire_.to_host.assign(20, std::byte{0x7f});
        sample = tick();
    }
    EXPECT_EQ(sample.fault, Fault::communication);
    EXPECT_TRUE(base::is_finite(sample.hip));
}

TEST_F(FalconTest, EncodersThatNoGripCanHaveAreNonsense)
{
    tick_with(homed_at({}));
    Sample sample;
    for (int i = 0; i < 21; ++i) {
        sample = tick_with({.encoders = {-30000, 30000, 0}, .legs_homed = all_legs});
    }
    EXPECT_EQ(sample.fault, Fault::communication);
    EXPECT_LT(base::norm(sample.hip - base::Position{}), 0.0001);
}

TEST_F(FalconTest, LosingItsHomingIsAFaultUntilItIsHomedAgain)
{
    tick_with(homed_at({}));
    const Sample lost = tick_with(Report{}, one_newton);
    EXPECT_EQ(lost.fault, Fault::not_calibrated);
    EXPECT_FALSE(lost.calibrated);
    EXPECT_EQ(wire_.heard.back().motors, Counts{});
    EXPECT_EQ(falcon_->calibrate(now_), CalibrationStep::sweep_joints);
    EXPECT_EQ(tick_with(homed_at({})).fault, Fault::none);
}

TEST_F(FalconTest, SaysWhenItHasGoneAndWhatItsCalibrationComesTo)
{
    tick();
    wire_.is_gone = true;
    EXPECT_EQ(tick().fault, Fault::disconnected);
    EXPECT_EQ(falcon_->calibrate(now_), CalibrationStep::failed);
}

TEST_F(FalconTest, CountsPressesOfTheCentreButton)
{
    Report report = homed_at({});
    report.buttons = 0x4 | 0x1; // centre and plus
    Sample sample;
    for (int i = 0; i < 7; ++i) sample = tick_with(report);
    EXPECT_TRUE(sample.gripping);
    EXPECT_EQ(sample.buttons, 0x3);
    EXPECT_EQ(sample.presses, 1);
}

TEST_F(FalconTest, IsLeftAtZero)
{
    tick_with(homed_at({}), one_newton);
    falcon_->halt();
    EXPECT_EQ(wire_.heard.back().motors, Counts{});
    tick_with(homed_at({}), one_newton);
    falcon_.reset();
    EXPECT_EQ(wire_.sent_now, 3);
    ASSERT_GE(wire_.heard.size(), 3U);
    for (auto last = wire_.heard.end() - 3; last != wire_.heard.end(); ++last) {
        EXPECT_EQ(*last, Command{});
    }
}

} // namespace
} // namespace hapnet::device::falcon
