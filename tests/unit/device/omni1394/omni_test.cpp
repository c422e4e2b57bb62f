// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/omni.hpp"
#include "tests/support/device/ungoverned.hpp"
#include "tests/support/omni1394/memory_link.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device::omni1394 {
namespace {

using namespace std::chrono_literals;

/// An Omni on a bus in memory. Each millisecond it is read, and gets a force.
struct OnABus {
    MemoryBus bus;
    std::unique_ptr<Device> device{};
    base::TimePoint now{1h};
    Sample sample{};

    explicit OnABus(Use use = Use::uncalibrated, bool begins_docked = true)
        : bus{FakeOmni{begins_docked}}
    {
        auto opened = Omni::open(std::make_unique<MemoryLink>(bus), {}, use);
        if (opened) device = *std::move(opened);
    }
    void play_for(base::Duration time, const glm::dvec3& newtons = {})
    {
        for (const base::TimePoint end = now + time; now < end;) {
            now += 1ms;
            bus.pass_one_millisecond();
            sample = device->read(now);
            device->apply(ungoverned({newtons}));
        }
    }
    /// Calibrates it, and moves it to the middle of the workspace.
    void take_out()
    {
        play_for(100ms);
        bus.omni.lead_to({});
        play_for(1500ms);
    }
    [[nodiscard]] const HostPacket& last() const { return *bus.omni.heard().back(); }
    [[nodiscard]] bool was_ever_pushed() const
    {
        for (const auto& packet : bus.omni.heard()) {
            if (!packet || packet->motors != glm::ivec3{0} || packet->motors_on) return true;
        }
        return false;
    }
};

TEST(Omni1394, StartsWithZeroSaysWhoItIsAndThatNobodyHasTriedIt)
{
    const OnABus omni;
    ASSERT_NE(omni.device, nullptr);
    EXPECT_EQ(omni.device->identity().serial, "70427300007");
    EXPECT_NE(omni.device->identity().note.find(never_run), std::string::npos);
    EXPECT_EQ(omni.device->capabilities().pacing, Pacing::device);
    ASSERT_EQ(omni.bus.omni.heard().size(), 1U);
    EXPECT_EQ(omni.last(), HostPacket{});
}

TEST(Omni1394, IsNotOpenedWhereItDoesNotAnswer)
{
    MemoryBus bus{FakeOmni{}};
    bus.refuses = true;
    const auto opened = Omni::open(std::make_unique<MemoryLink>(bus), {}, Use::read_only);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().fault, Fault::communication);
    EXPECT_FALSE(bus.is_open);
}

TEST(Omni1394, SaysWhereTheStylusIsOnceItHasBeenDocked)
{
    OnABus omni;
    omni.play_for(30ms);
    EXPECT_FALSE(omni.sample.calibrated);
    omni.take_out();
    EXPECT_TRUE(omni.sample.calibrated);
    EXPECT_FALSE(omni.sample.docked);
    // Rounding here and in the inkwell: half a count each, in three joints.
    EXPECT_LT(base::norm(omni.sample.hip - omni.bus.omni.plant().tip()), 3 * 0.09e-3);
}

TEST(Omni1394, UndockedAtTheStartIsNotCalibratedAndGetsNoForce)
{
    OnABus omni{Use::uncalibrated, false};
    omni.play_for(500ms, {1.0, 0.0, 0.0});
    EXPECT_FALSE(omni.sample.calibrated);
    EXPECT_EQ(omni.sample.fault, Fault::none);
    EXPECT_EQ(omni.device->calibrate(omni.now), CalibrationStep::dock_stylus);
    EXPECT_FALSE(omni.was_ever_pushed());
    EXPECT_TRUE(omni.last().dock_light_flashes_fast);
}

TEST(Omni1394, SendsTheTransposedJacobianTimesTheForce)
{
    OnABus omni;
    omni.take_out();
    const glm::dvec3 force{0.1, -0.2, 0.15};
    omni.play_for(1ms, force);
    EXPECT_TRUE(omni.last().motors_on);
    const glm::dvec3 torque = FakeOmni::torque_of(omni.last().motors);
    const glm::dvec3 wanted = glm::transpose(omni::jacobian_at(omni.sample.hip)) * force;
    for (const int joint : {0, 1, 2}) {
        EXPECT_NEAR(torque[joint], wanted[joint], omni::torque_max_nm[joint] / 2047 / 2);
    }
}

TEST(Omni1394, NeverSaysMoreThanAQuarterUncalibrated)
{
    OnABus omni;
    omni.take_out();
    for (int ms = 0; ms < 300; ++ms) {
        omni.play_for(1ms, {3.3 * std::cos(0.1 * ms), 3.3 * std::sin(0.1 * ms), 1.0});
        for (const int joint : {0, 1, 2}) ASSERT_LE(std::abs(omni.last().motors[joint]), 511);
    }
    EXPECT_TRUE(omni.was_ever_pushed());
}

TEST(Omni1394, SendsNothingButZerosWithTheMotorsOffWhileItIsReadOnly)
{
    OnABus omni{Use::read_only};
    omni.take_out();
    omni.play_for(300ms, {1.0, 1.0, 1.0});
    EXPECT_GT(omni.bus.omni.heard().size(), 1500U);
    EXPECT_FALSE(omni.was_ever_pushed());
}

TEST(Omni1394, SendsZeroWithTheMotorsOffFromEveryFaultOn)
{
    const auto zero_after = [](auto trouble, Fault fault) {
        OnABus omni;
        omni.take_out();
        omni.play_for(100ms, {0.5, 0.0, 0.0});
        ASSERT_TRUE(omni.last().motors_on);
        trouble(omni);
        omni.play_for(25ms, {0.5, 0.0, 0.0});
        EXPECT_EQ(omni.sample.fault, fault);
        EXPECT_EQ(omni.last().motors, glm::ivec3{0}) << name_of(fault);
        EXPECT_FALSE(omni.last().motors_on);
    };
    zero_after([](OnABus& omni) { omni.bus.resets = 1; }, Fault::not_calibrated);
    zero_after([](OnABus& omni) { omni.bus.omni.garble(true); }, Fault::communication);
    zero_after([](OnABus& omni) { omni.bus.omni.jump({0, 300, 0}); }, Fault::not_calibrated);
    zero_after([](OnABus& omni) { omni.bus.omni.skip(1U << 30U); }, Fault::not_calibrated);
}

TEST(Omni1394, SendsZeroToADeviceThatIsSilentAndOnce20MillisecondsHavePassed)
{
    OnABus omni;
    omni.take_out();
    omni.play_for(100ms, {0.5, 0.0, 0.0});
    omni.bus.omni.stall(true);
    omni.play_for(19ms, {0.5, 0.0, 0.0});
    EXPECT_EQ(omni.sample.fault, Fault::none);
    omni.play_for(1ms, {0.5, 0.0, 0.0});
    EXPECT_EQ(omni.sample.fault, Fault::timeout);
    omni.bus.omni.stall(false); // it is back, but has no packet yet
    omni.now += 1ms;
    omni.sample = omni.device->read(omni.now);
    omni.device->apply(ungoverned({{0.5, 0.0, 0.0}}));
    EXPECT_EQ(omni.last().motors, glm::ivec3{0});
}

TEST(Omni1394, IsNotCalibratedAfterABusResetAndFlashesForItsStylusUntilThatIsDocked)
{
    OnABus omni;
    omni.take_out();
    omni.bus.resets = 1;
    omni.play_for(500ms, {0.5, 0.0, 0.0});
    EXPECT_EQ(omni.sample.fault, Fault::not_calibrated);
    EXPECT_FALSE(omni.sample.calibrated);
    EXPECT_EQ(omni.device->calibrate(omni.now), CalibrationStep::dock_stylus);
    EXPECT_TRUE(omni.last().dock_light_flashes_fast);
    EXPECT_FALSE(omni.last().dock_light_flashes); // both: a steady light
    omni.bus.omni.lead_to(omni::position_of(omni::inkwell_pose));
    omni.play_for(1500ms);
    EXPECT_TRUE(omni.sample.docked);
    EXPECT_EQ(omni.sample.fault, Fault::none);
}

TEST(Omni1394, SaysThatItHasGone)
{
    OnABus omni;
    omni.take_out();
    omni.bus.gone = true;
    omni.play_for(1ms, {0.5, 0.0, 0.0});
    EXPECT_EQ(omni.sample.fault, Fault::disconnected);
    EXPECT_EQ(omni.device->calibrate(omni.now), CalibrationStep::failed);
}

TEST(Omni1394, GetsZeroOfWhatIsNotFinite)
{
    OnABus omni;
    omni.take_out();
    omni.play_for(1ms, {std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0});
    EXPECT_EQ(omni.last().motors, glm::ivec3{0});
}

TEST(Omni1394, CountsThePacketsThatItHasLostAndThoseThatItDidNotUnderstand)
{
    OnABus omni;
    omni.take_out();
    omni.bus.omni.skip(5);
    omni.play_for(1ms);
    omni.bus.omni.garble(true);
    omni.play_for(3ms);
    omni.bus.omni.garble(false);
    omni.play_for(10ms);
    const auto& device = dynamic_cast<const Omni&>(*omni.device);
    EXPECT_EQ(device.lost(), 5U + 3U);
    EXPECT_EQ(device.garbled(), 3U);
    EXPECT_EQ(omni.sample.fault, Fault::none);
}

TEST(Omni1394, DebouncesItsButtons)
{
    OnABus omni;
    omni.take_out();
    omni.bus.omni.press(0b01);
    omni.play_for(4ms);
    EXPECT_FALSE(omni.sample.gripping);
    omni.play_for(3ms);
    EXPECT_TRUE(omni.sample.gripping);
    EXPECT_EQ(omni.sample.presses, 1);
}

TEST(Omni1394, IsHaltedByAZeroAtOnce)
{
    OnABus omni;
    omni.take_out();
    omni.play_for(100ms, {0.5, 0.0, 0.0});
    omni.device->halt();
    EXPECT_EQ(omni.last(), HostPacket{});
}

TEST(Omni1394, EndsWithThreeZerosAndTheStreamOff)
{
    OnABus omni;
    omni.take_out();
    omni.play_for(100ms, {0.5, 0.0, 0.0});
    const std::size_t before = omni.bus.omni.heard().size();
    omni.device.reset();
    ASSERT_EQ(omni.bus.omni.heard().size(), before + 3);
    for (std::size_t i = before; i < before + 3; ++i) {
        EXPECT_EQ(omni.bus.omni.heard()[i], HostPacket{});
    }
    EXPECT_FALSE(omni.bus.omni.is_streaming());
    EXPECT_FALSE(omni.bus.is_open);
}

TEST(Omni1394, BeatsOnceForEachMillisecondOfPacketsAtTheBussOwnRateToo)
{
    for (const bool every_cycle : {false, true}) {
        OnABus omni;
        int beats = 0;
        int packets = 0;
        const auto speak = [&] {
            omni.bus.cycle = (omni.bus.cycle + (every_cycle ? 1 : 8)) % 8000;
            omni.bus.say(omni.bus.omni.live(every_cycle ? 125us : 1ms));
            ++packets;
        };
        // In reality the packets come while it waits; here before each wait.
        while (packets < 800) {
            for (int i = 0; i < (every_cycle ? 4 : 1); ++i) speak();
            omni.device->pace([&] {
                ++beats;
                omni.now += 1ms;
                std::ignore = omni.device->read(omni.now);
                return true;
            });
        }
        // At most one each 6 cycles of the 800: here each second time that 4 have come.
        EXPECT_EQ(beats, every_cycle ? 100 : 800) << every_cycle;
    }
}

TEST(Omni1394, StopsBeatingWhenItIsToldToWhenItIsSilentAndWhenItHasGone)
{
    OnABus omni;
    omni.bus.pass_one_millisecond();
    omni.bus.pass_one_millisecond();
    int beats = 0;
    omni.device->pace([&] {
        ++beats;
        return false;
    });
    EXPECT_EQ(beats, 1);
    omni.bus.gone = true;
    omni.device->pace([&] {
        ++beats;
        std::ignore = omni.device->read(omni.now);
        return true;
    });
    EXPECT_EQ(beats, 2);
}

TEST(Omni1394, IsOneOfSeveral)
{
    OnABus left;
    OnABus right;
    left.take_out();
    right.play_for(100ms);
    left.play_for(10ms, {0.0, 0.5, 0.0});
    EXPECT_TRUE(left.was_ever_pushed());
    EXPECT_FALSE(right.was_ever_pushed());
    EXPECT_TRUE(right.sample.docked);
}

} // namespace
} // namespace hapnet::device::omni1394
