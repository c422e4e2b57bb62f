// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Faults that only a Falcon has, through unmodified libusb.
#include "device/falcon/transport/falcons.hpp"
#include "device/governor.hpp"
#include "tests/conformance/falcon/emulated.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

namespace hapnet::conformance {
namespace {

using namespace std::chrono_literals;
using device::Fault;
using device::falcon::Command;
using device::falcon::Counts;
using device::falcon::find_falcons;
using device::falcon::open_falcon;

/// A file for one test, removed with it.
class File {
public:
    explicit File(std::span<const std::byte> bytes)
        : path_{::testing::TempDir() + "hapnet-firmware-" + std::to_string(getpid())}
    {
        std::ofstream stream{path_, std::ios::binary};
        for (const std::byte byte : bytes) stream.put(static_cast<char>(byte));
    }
    ~File() { std::remove(path_.c_str()); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// Drops the capabilities of this thread, so that file modes bind root like other users.
class WithoutRootsRights {
public:
    WithoutRootsRights()
    {
        syscall(SYS_capget, &header_, data_.data());
        auto less = data_;
        for (auto& half : less) half.effective = 0;
        syscall(SYS_capset, &header_, less.data());
    }
    ~WithoutRootsRights() { syscall(SYS_capset, &header_, data_.data()); }
    WithoutRootsRights(const WithoutRootsRights&) = delete;
    WithoutRootsRights& operator=(const WithoutRootsRights&) = delete;

private:
    __user_cap_header_struct header_{_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, 2> data_{};
};

class Falcon : public ::testing::Test {
protected:
    /// Reads and applies as fast as possible for a duration.
    device::Sample play(device::Device& falcon, base::Duration duration,
                        const device::GovernedForce& force = {})
    {
        device::Sample sample;
        const base::TimePoint end = net::monotonic_now() + duration;
        for (auto now = net::monotonic_now(); now < end; now = net::monotonic_now()) {
            if (!sample.calibrated) std::ignore = falcon.calibrate(now);
            sample = falcon.read(now);
            falcon.apply(force);
        }
        return sample;
    }
    [[nodiscard]] std::unique_ptr<device::Device> open_homed()
    {
        emulated_.usb.with_model([&] { emulated_.falcon.help_homing(); });
        auto opened = open_falcon("", "");
        EXPECT_TRUE(opened) << opened.error().message;
        if (!opened) return nullptr;
        for (int i = 0; i < 50 && !play(**opened, 100ms).calibrated; ++i) {}
        return *std::move(opened);
    }
    [[nodiscard]] std::vector<Command> commands()
    {
        return emulated_.usb.with_model([&] { return emulated_.falcon.commands(); });
    }

    EmulatedFalcon emulated_{"ftdi_sio"};
};

const device::GovernedForce a_push = device::ungoverned({{0.5, 0.0, 0.0}});

TEST_F(Falcon, IsFoundByItsSerialAndSaidToBeUnmet)
{
    const auto found = find_falcons();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].identity.serial, "FALC0001");
    EXPECT_EQ(found[0].identity.note, "never run on the physical device");
    EXPECT_FALSE(found[0].unusable) << found[0].unusable->message;
    EXPECT_TRUE(emulated_.usb.kernel_has_it()); // looking at it claims nothing
    EXPECT_TRUE(open_falcon("usb-1-2", ""));    // its port is a name, too
    const auto other = open_falcon("FALC0002", "");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().fault, Fault::not_found);
}

TEST_F(Falcon, IsTakenFromTheKernelsDriverAndGivenBack)
{
    auto opened = open_falcon("", "");
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_FALSE(emulated_.usb.kernel_has_it());
    opened->reset();
    EXPECT_TRUE(emulated_.usb.kernel_has_it());
}

TEST_F(Falcon, WithoutFirmwareSaysWhatToGiveIt)
{
    emulated_.usb.with_model([&] { emulated_.falcon.lose_firmware(); });
    const auto opened = open_falcon("FALC0001", "");
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().fault, Fault::firmware_missing);
    EXPECT_NE(opened.error().message.find("--falcon-firmware FILE"), std::string::npos);
    const auto no_file = open_falcon("FALC0001", "/no/such/file");
    ASSERT_FALSE(no_file);
    EXPECT_EQ(no_file.error().fault, Fault::firmware_missing);
    EXPECT_NE(no_file.error().message.find("/no/such/file"), std::string::npos);
}

TEST_F(Falcon, IsGivenItsFirmwareAlsoWhenTheFirstAttemptsFail)
{
    emulated_.usb.with_model([&] {
        emulated_.falcon.lose_firmware();
        emulated_.falcon.spoil_loads(2);
    });
    const File file{test::FakeFalcon::firmware()};
    const auto opened = open_falcon("FALC0001", file.path());
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(emulated_.usb.with_model([&] { return emulated_.falcon.loads(); }), 3);
    EXPECT_EQ(play(**opened, 100ms).fault, Fault::none);
}

TEST_F(Falcon, ThatRefusesItsFirmwareSaysSo)
{
    emulated_.usb.with_model([&] { emulated_.falcon.lose_firmware(); });
    const std::vector<std::byte> wrong(500, std::byte{1});
    const File file{wrong};
    const auto opened = open_falcon("FALC0001", file.path());
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().fault, Fault::communication);
}

TEST_F(Falcon, ThatMayNotBeOpenedSaysWhyAndTheCure)
{
    const std::string node = emulated_.testbed.real_path("/dev/bus/usb/001/002");
    ASSERT_EQ(chmod(node.c_str(), 0), 0);
    const WithoutRootsRights rights;
    const auto opened = open_falcon("", "");
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().fault, Fault::permission);
    EXPECT_NE(opened.error().message.find("/dev/bus/usb/001/002"), std::string::npos);
    EXPECT_NE(opened.error().message.find("udev"), std::string::npos);
    const auto found = find_falcons();
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].unusable);
    EXPECT_EQ(found[0].unusable->fault, Fault::permission);
    EXPECT_EQ(found[0].identity.serial, "usb-1-2");
}

TEST_F(Falcon, ThatAnotherProgramHasIsSaidToBeInUse)
{
    const auto first = open_falcon("", "");
    ASSERT_TRUE(first) << first.error().message;
    const auto found = find_falcons();
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].unusable);
    EXPECT_EQ(found[0].unusable->fault, Fault::in_use);
    const auto second = open_falcon("", "");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().fault, Fault::in_use);
}

TEST_F(Falcon, UnpluggedWhileItsFirmwareIsLoadedIsGone)
{
    emulated_.usb.with_model([&] {
        emulated_.falcon.lose_firmware();
        emulated_.falcon.spoil_loads(1000);
    });
    const File file{test::FakeFalcon::firmware()};
    std::thread person{[&] {
        const auto loads = [&] { return emulated_.falcon.loads(); };
        while (emulated_.usb.with_model(loads) == 0) {
            net::sleep_until(net::monotonic_now() + 1ms);
        }
        emulated_.usb.unplug();
    }};
    const auto opened = open_falcon("", file.path());
    person.join();
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().fault, Fault::disconnected);
}

TEST_F(Falcon, UnpluggedBeforeItIsHomedIsGone)
{
    const auto opened = open_falcon("", "");
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_FALSE(play(**opened, 50ms).calibrated);
    emulated_.usb.unplug();
    EXPECT_EQ(play(**opened, 50ms).fault, Fault::disconnected);
}

TEST_F(Falcon, PluggedInAgainIsHomedStillAndPushesAgain)
{
    auto falcon = open_homed();
    ASSERT_TRUE(falcon);
    play(*falcon, 50ms, a_push);
    emulated_.usb.unplug();
    EXPECT_EQ(play(*falcon, 50ms, a_push).fault, Fault::disconnected);
    falcon.reset();
    emulated_.usb.plug_in();
    const std::size_t before = commands().size();
    auto again = open_falcon("FALC0001", "");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_TRUE(play(**again, 50ms).calibrated);
    for (std::size_t i = before; i < commands().size(); ++i) {
        EXPECT_EQ(commands()[i].motors, Counts{});
    }
    play(**again, 50ms, a_push);
    EXPECT_NE(commands().back().motors, Counts{});
}

TEST_F(Falcon, IsToldZeroLastWhenItLosesItsHomingAndWhenItTalksNonsense)
{
    const std::array<std::pair<std::function<void()>, Fault>, 2> fates{
        {{[&] { emulated_.falcon.garble(true); }, Fault::communication},
         {[&] { emulated_.falcon.lose_homing(); }, Fault::not_calibrated}}};
    auto falcon = open_homed();
    ASSERT_TRUE(falcon);
    for (const auto& [befalls, fault] : fates) {
        play(*falcon, 20ms, a_push);
        ASSERT_NE(commands().back().motors, Counts{});
        emulated_.usb.with_model(befalls);
        device::Governor governor{device::GovernorLimits{}};
        device::Sample sample;
        const base::TimePoint end = net::monotonic_now() + 200ms;
        for (auto now = net::monotonic_now(); now < end; now = net::monotonic_now()) {
            sample = falcon->read(now);
            falcon->apply(governor.govern({{{1.0, 0.0, 0.0}}, true}, sample, now));
        }
        EXPECT_EQ(sample.fault, fault);
        EXPECT_EQ(commands().back().motors, Counts{});
        emulated_.usb.with_model([&] { emulated_.falcon.garble(false); });
    }
    EXPECT_EQ(commands().back().lights, device::falcon::Lights::red);
}

TEST_F(Falcon, IsHaltedAgainWhereAForceHasOvertakenTheFirstHalt)
{
    auto falcon = open_homed();
    ASSERT_TRUE(falcon);
    const std::uint64_t before = play(*falcon, 20ms, a_push).sequence;
    while (falcon->read(net::monotonic_now()).sequence == before) {} // it may be told something now
    // The loop hangs twice between two calls of the device.
    for (int i = 0; i < 5; ++i) {
        falcon->halt();
        net::sleep_until(net::monotonic_now() + 2ms);
        EXPECT_EQ(commands().back().motors, Counts{});
    }
    falcon->apply(a_push);
    net::sleep_until(net::monotonic_now() + 2ms);
    EXPECT_NE(commands().back().motors, Counts{});
    falcon->halt();
    net::sleep_until(net::monotonic_now() + 2ms);
    EXPECT_EQ(commands().back().motors, Counts{});
}

TEST_F(Falcon, GoesOnUnderTheHaltsOfAnotherThreadUntilTheLastOne)
{
    auto falcon = open_homed();
    ASSERT_TRUE(falcon);
    const std::uint64_t before = play(*falcon, 20ms, a_push).sequence;
    std::atomic<bool> ends{false};
    std::thread watchdog{[&] {
        while (!ends) {
            falcon->halt();
            net::sleep_until(net::monotonic_now() + 1ms);
        }
    }};
    const std::uint64_t after = play(*falcon, 300ms, a_push).sequence;
    ends = true;
    watchdog.join();
    EXPECT_GT(after, before + 10); // of some 200; the machine may be busy
    EXPECT_NE(play(*falcon, 20ms, a_push).fault, Fault::disconnected);
    falcon->halt();
    net::sleep_until(net::monotonic_now() + 5ms);
    EXPECT_EQ(commands().back().motors, Counts{});
}

TEST_F(Falcon, IsHeardFromAtLeast200TimesASecond)
{
    // The device is emulated, so this says nothing about the rate of a real one. The best of
    // several stretches counts, because other load may stop this process for a while.
    auto falcon = open_homed();
    ASSERT_TRUE(falcon);
    std::uint64_t rate = 0;
    for (int i = 0; i < 20 && rate <= 500; ++i) {
        const std::uint64_t before = play(*falcon, 1ms, a_push).sequence;
        rate = std::max(rate, 2 * (play(*falcon, 500ms, a_push).sequence - before));
    }
    std::printf("closed loop: %llu cycles/s\n", static_cast<unsigned long long>(rate));
    RecordProperty("cycles_per_second", static_cast<int>(rate));
    EXPECT_GT(rate, 200U);
}

} // namespace
} // namespace hapnet::conformance
