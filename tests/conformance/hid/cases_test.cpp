// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Tests of HID devices besides the suite, through unmodified hidapi.
#include "device/hid/transport/hids.hpp"
#include "proto/net/clock.hpp"
#include "tests/conformance/hid/emulated.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

namespace hapnet::conformance {
namespace {

using namespace std::chrono_literals;
using device::Fault;
using device::ungoverned;
using device::hid::find_hids;
using device::hid::open_hid;
using hid_double::FakePid;

const device::hid::Options with_force{.force_full_n = FakePid::force_full_n};
const base::Force right{{1.0, 0.0, 0.0}};

/// An ordinary mouse.
class Mouse final : public umockdev::HidModel {
public:
    void on_output(std::span<const std::byte> /*report*/) override {}
    void on_feature(std::span<const std::byte> /*report*/) override {}
    std::optional<std::vector<std::byte>> feature(std::uint8_t /*id*/) override { return {}; }
};

class Hid : public ::testing::Test {
protected:
    std::unique_ptr<device::Device> open()
    {
        auto opened = open_hid("", with_force);
        EXPECT_TRUE(opened.has_value()) << (opened ? "" : opened.error().message);
        return opened ? *std::move(opened) : nullptr;
    }

    /// Plays a millisecond of the device's time, which takes longer where the machine is busy.
    device::Sample tick(device::Device& device, const base::Force& force)
    {
        const base::TimePoint due = net::monotonic_now() + 1ms;
        pid_.pass(1ms);
        now_ += 1ms;
        const device::Sample sample = device.read(now_);
        device.apply(ungoverned(force));
        net::sleep_until(due);
        return sample;
    }

    template <typename Condition>
    bool wait_until(Condition condition)
    {
        for (int i = 0; i < 2000; ++i) {
            if (condition()) return true;
            net::sleep_until(net::monotonic_now() + 1ms);
        }
        return false;
    }

    bool pushes()
    {
        return pid_.with([](const FakePid& pid) { return !pid.push().is_zero(); });
    }
    /// True if the last reports of all kinds contain no force and no power.
    bool ends_at_zero()
    {
        return pid_.with([](const FakePid& pid) {
            const auto& all = pid.pushes();
            return all.size() >= 3 && std::all_of(all.end() - 3, all.end(), [](const auto& push) {
                       return push.is_zero() && !push.motors_on;
                   });
        });
    }

    umockdev::Testbed testbed_;
    EmulatedPid pid_{testbed_};
    base::TimePoint now_{1000s};
};

TEST_F(Hid, IsFoundWithItsNameAndAMouseBesideItIsNot)
{
    Mouse model;
    const umockdev::HidrawDevice mouse{testbed_,
                                       {.vendor = 0x046d,
                                        .product = 0xc077,
                                        .name = "Mouse",
                                        .serial = "",
                                        .report_descriptor = hid_double::mouse_descriptor(),
                                        .number = 1},
                                       model};
    const auto found = find_hids({});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].identity.backend, "hid");
    EXPECT_EQ(found[0].identity.serial, "FFB0001");
    EXPECT_EQ(found[0].identity.model, "Force Board (USB HID PID)");
    EXPECT_EQ(found[0].identity.note,
              "never run on the physical device; no force until --hid-force says what full scale "
              "is at the grip");
    EXPECT_FALSE(found[0].unusable.has_value());
}

TEST_F(Hid, IsChosenBySerialOrByNode)
{
    EmulatedPid other{testbed_, 1};
    EXPECT_EQ(open_hid("FFB0001", {}).value()->identity().serial, "FFB0001");
    EXPECT_EQ(open_hid("hidraw0", {}).value()->identity().serial, "FFB0001");
    EXPECT_EQ(open_hid("hidraw1", {}).value()->identity().serial, "hidraw1");
    const auto missing = open_hid("FFB0002", {});
    ASSERT_FALSE(missing.has_value());
    EXPECT_EQ(missing.error().fault, Fault::not_found);
    EXPECT_NE(missing.error().message.find("list-devices"), std::string::npos);
}

TEST_F(Hid, InUseIsShownAsSuchAndTheNextOneIsTaken)
{
    EmulatedPid other{testbed_, 1};
    const auto first = open_hid("", {});
    ASSERT_TRUE(first.has_value());
    const auto second = open_hid("", {});
    ASSERT_TRUE(second.has_value());
    EXPECT_NE((*first)->identity().serial, (*second)->identity().serial);
    for (const auto& one : find_hids({})) {
        ASSERT_TRUE(one.unusable.has_value());
        EXPECT_EQ(one.unusable->fault, Fault::in_use);
    }
}

TEST_F(Hid, WithoutPermissionIsListedWithTheCure)
{
    const std::string node = testbed_.real_path("/dev/hidraw0");
    chmod(node.c_str(), 0);
    chmod(testbed_.real_path("").c_str(), 0755);
    // umockdev asks its own side for the node even where the kernel has refused access.
    for (const char* const its : {"/ioctl", "/ioctl/dev", "/ioctl/dev/hidraw0"}) {
        chmod(testbed_.real_path(its).c_str(), 0777);
    }
    const bool was_root = geteuid() == 0; // whom no mode keeps out
    ASSERT_EQ(was_root ? seteuid(65534) : 0, 0);
    const auto found = find_hids({});
    const auto opened = open_hid("", with_force);
    ASSERT_EQ(was_root ? seteuid(0) : 0, 0);
    chmod(node.c_str(), 0600);
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].unusable.has_value());
    EXPECT_EQ(found[0].unusable->fault, Fault::permission);
    ASSERT_FALSE(opened.has_value());
    EXPECT_EQ(opened.error().fault, Fault::permission);
    EXPECT_EQ(opened.error().message,
              "no permission to use /dev/hidraw0: install the udev rules (hapnet-peer doctor says "
              "how), then unplug the device and plug it in again");
}

TEST_F(Hid, WithoutAFullScaleIsOnlyReadAndToldNothing)
{
    auto device = open_hid("", {}).value();
    for (int i = 0; i < 50; ++i) EXPECT_EQ(tick(*device, right).fault, Fault::none);
    device->halt();
    device.reset();
    EXPECT_TRUE(pid_.with([](const FakePid& pid) { return pid.pushes().empty(); }));
}

TEST_F(Hid, WithoutRoomForAnEffectSaysSoAndIsLeftAsItWas)
{
    pid_.with([](FakePid& pid) { pid.limit_places(1); });
    const auto full = open_hid("", with_force);
    ASSERT_FALSE(full.has_value());
    EXPECT_EQ(full.error().fault, Fault::in_use);
    EXPECT_NE(full.error().message.find("no room for another effect"), std::string::npos);
    EXPECT_EQ(pid_.with([](const FakePid& pid) { return pid.places_taken(); }), 0U);
    EXPECT_TRUE(ends_at_zero());
    EXPECT_TRUE(open_hid("", {}).has_value()); // and is not held any more
}

TEST_F(Hid, ThatCannotLoadAnEffectSaysSo)
{
    pid_.with([](FakePid& pid) { pid.refuse_effects(); });
    const auto refused = open_hid("", with_force);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().fault, Fault::communication);
    EXPECT_TRUE(ends_at_zero());
}

TEST_F(Hid, StuckInAWriteHoldsUpNoTickAndNoEnd)
{
    auto device = open();
    ASSERT_TRUE(device);
    while (!pushes()) tick(*device, right);
    pid_.hidraw().stall(true);
    const base::TimePoint start = net::monotonic_now();
    Fault fault = Fault::none;
    for (int i = 0; i < 100; ++i) fault = tick(*device, right).fault;
    EXPECT_EQ(fault, Fault::timeout);
    device->halt();
    device.reset();
    // A write to a device that takes no data would never end here, and after 5 s at a real one.
    EXPECT_LT(net::monotonic_now() - start, 4s);
    EXPECT_EQ(open_hid("", {}).error().fault, Fault::in_use); // its write is still under way
    pid_.hidraw().stall(false);
    EXPECT_TRUE(wait_until([] { return open_hid("", {}).has_value(); }));
    EXPECT_TRUE(ends_at_zero());
}

TEST_F(Hid, PulledOutInTheMiddleOfAWriteIsGone)
{
    auto device = open();
    ASSERT_TRUE(device);
    while (!pushes()) tick(*device, right);
    pid_.hidraw().stall(true);
    tick(*device, right);
    pid_.hidraw().unplug();
    EXPECT_TRUE(wait_until([&] { return tick(*device, right).fault == Fault::disconnected; }));
}

TEST_F(Hid, ThatSaysNothingWhileNothingMovesIsNoSilentOneAtRestAndUnderForce)
{
    auto device = open();
    ASSERT_TRUE(device);
    tick(*device, {});
    for (const base::Force& force : {base::Force{}, right}) {
        const std::uint64_t before = device->read(now_).sequence;
        EXPECT_TRUE(wait_until([&] {
            now_ += 1ms;
            const device::Sample sample = device->read(now_);
            device->apply(ungoverned(force));
            EXPECT_EQ(sample.fault, Fault::none);
            return sample.sequence > before + 10;
        }));
    }
    EXPECT_TRUE(pushes());
}

/// The device reports its place, the report is read, and both forces of the answer arrive.
TEST_F(Hid, RunsAClosedLoopWellAboveTwoHundredCyclesPerSecond)
{
    auto device = open();
    ASSERT_TRUE(device);
    std::uint64_t heard = 0;
    int answers = 0;
    const auto cycle = [&] {
        pid_.pass(1ms);
        now_ += 1ms;
        device::Sample sample;
        while ((sample = device->read(now_)).sequence == heard) {}
        heard = sample.sequence;
        const base::Force answer{{1.0 - 50.0 * sample.hip.x(), 0.001 * (++answers % 1000), 0.0}};
        device->apply(ungoverned(answer));
        const auto has_arrived = [&](const FakePid& pid) {
            const auto& force = pid.push().force_n;
            constexpr double step = FakePid::force_full_n / 32767;
            return std::abs(force[0] - answer.x()) < step && std::abs(force[1] - answer.y()) < step;
        };
        while (!pid_.with(has_arrived)) net::sleep_until(net::monotonic_now() + 10us);
    };
    // The best of short stretches, because a busy machine does not mean a slow library.
    double best_hz = 0.0;
    for (int stretch = 0; stretch < 20; ++stretch) {
        constexpr int cycles = 50;
        const base::TimePoint start = net::monotonic_now();
        for (int i = 0; i < cycles; ++i) cycle();
        best_hz = std::max(best_hz, cycles / base::to_seconds(net::monotonic_now() - start));
    }
    std::printf("closed loop over umockdev: %.0f cycles/s\n", best_hz);
    EXPECT_GT(best_hz, 200.0);
    EXPECT_GT(device->read(now_).hip.x(), 0.001); // the hand has given way
}

} // namespace
} // namespace hapnet::conformance
