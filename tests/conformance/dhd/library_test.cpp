// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Tests of devices behind a library that a thread of our own calls.
#include "device/dhd/transport/dhds.hpp"
#include "proto/net/clock.hpp"
#include "tests/conformance/dhd/fake.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace hapnet::conformance {
namespace {

using namespace std::chrono_literals;

class Dhd : public ::testing::Test {
protected:
    ~Dhd() override
    {
        fake_.set(FakeDhdFate::stalled, false);
        device_.reset();
    }

    void open(const std::string& serial = "4711")
    {
        fake_.set(FakeDhdFate::calibrated, true);
        auto opened = device::dhd::open_dhd(serial, HAPNET_FAKE_DHD);
        ASSERT_TRUE(opened) << opened.error().message;
        device_ = *std::move(opened);
    }
    static void pass(base::Duration duration) { net::sleep_until(net::monotonic_now() + duration); }
    /// Repeats this force and reads every millisecond until the condition holds; at most 5 s.
    template <typename Condition>
    bool push_until(const base::Force& force, Condition is_wanted)
    {
        for (int i = 0; i < 5000; ++i) {
            device_->apply(device::ungoverned(force));
            if (is_wanted(device_->read(net::monotonic_now()))) return true;
            pass(1ms);
        }
        return false;
    }
    bool push_until_fault(device::Fault fault)
    {
        return push_until({{1.0, 0.0, 0.0}}, [&](const auto& it) { return it.fault == fault; });
    }

    FakeDhd fake_;
    std::unique_ptr<device::Device> device_;
};

TEST_F(Dhd, SaysWhichLibraryIsMissingAndWhatToDo)
{
    const auto none = device::dhd::open_dhd("", "/no/such/libdhd.so");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, device::Fault::library_missing);
    for (const char* word : {"/no/such/libdhd.so", "Force Dimension", "--dhd-library"}) {
        EXPECT_NE(none.error().message.find(word), std::string::npos) << word;
    }
}

TEST_F(Dhd, SaysWhichFunctionALibraryLacks)
{
    const auto none = device::dhd::open_dhd("", HAPNET_FAKE_HD_WITHOUT_SCHEDULER);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, device::Fault::library_missing);
    EXPECT_NE(none.error().message.find("dhdGetDeviceCount()"), std::string::npos);
}

TEST_F(Dhd, ListsTheLibrarysDeviceOrWhyItCannotBeUsed)
{
    EXPECT_FALSE(device::dhd::find_dhds(HAPNET_FAKE_DHD).at(0).unusable);
    const auto found = device::dhd::find_dhds("/no/such/libdhd.so");
    ASSERT_FALSE(found.empty());
    ASSERT_TRUE(found[0].unusable);
    EXPECT_EQ(found[0].unusable->fault, device::Fault::library_missing);
    EXPECT_EQ(found[0].identity.note, device::never_run);
}

TEST_F(Dhd, OpensTheOneWithTheSerialNumberAndLeavesTheOthers)
{
    open("4712");
    EXPECT_EQ(device_->identity().serial, "4712");
    const auto first = device::dhd::open_dhd("", HAPNET_FAKE_DHD);
    ASSERT_TRUE(first);
    EXPECT_EQ((*first)->identity().serial, "4711");
    const auto none = device::dhd::open_dhd("4713", HAPNET_FAKE_DHD);
    ASSERT_FALSE(none);
    EXPECT_FALSE(none.error().message.empty());
}

TEST_F(Dhd, TurnsForcesIntoTheLibrarysFrameAndPositionsOutOfIt)
{
    open();
    const base::Force force{{0.1, 0.2, 0.3}}; // right, up, toward the user
    EXPECT_TRUE(push_until(force, [](const auto& it) { return it.hip.value.z > 5e-4; }));
    const auto commands = fake_.commands();
    EXPECT_TRUE(std::any_of(commands.begin(), commands.end(), [](const FakeDhdCommand& it) {
        return it.motors_on && it.force_n[0] == 0.3 && it.force_n[1] == 0.1 && it.force_n[2] == 0.2;
    }));
    const auto sample = device_->read(net::monotonic_now());
    EXPECT_NEAR(sample.hip.value.x / sample.hip.value.z, 1.0 / 3.0, 1e-9); // a spring holds it
    EXPECT_NEAR(sample.hip.value.y / sample.hip.value.z, 2.0 / 3.0, 1e-9);
}

TEST_F(Dhd, IsAtFaultWhenItsControllerHasSwitchedTheMotorsOffForItsSpeed)
{
    open();
    const base::Force force{{1.0, 0.0, 0.0}};
    ASSERT_TRUE(push_until(force, [](const auto& it) { return it.hip.value.x > 1e-3; }));
    fake_.set(FakeDhdFate::tripped, true);
    EXPECT_TRUE(push_until_fault(device::Fault::over_velocity));
}

TEST_F(Dhd, IsAtFaultWithItsController)
{
    open();
    fake_.set(FakeDhdFate::in_error, true);
    EXPECT_TRUE(push_until_fault(device::Fault::internal));
}

TEST_F(Dhd, DropsAForceThatNobodyRepeats)
{
    open();
    ASSERT_TRUE(
        push_until({{1.0, 0.0, 0.0}}, [](const auto& it) { return it.hip.value.x > 1e-3; }));
    pass(200ms); // 20 ms, and what a busy machine adds
    const FakeDhdCommand last = fake_.commands().back();
    EXPECT_EQ(last.force_n[1], 0.0);
    EXPECT_FALSE(last.motors_on);
}

TEST_F(Dhd, CountsAPressOfTheButton)
{
    open();
    fake_.set(FakeDhdFate::pressed, true);
    EXPECT_TRUE(push_until({}, [](const auto& it) { return it.gripping && it.presses == 1; }));
}

TEST_F(Dhd, EndsWhileACallOfTheLibraryHangs)
{
    open();
    fake_.set(FakeDhdFate::stalled, true);
    pass(20ms);
    const auto before = net::monotonic_now();
    device_.reset();
    EXPECT_LT(net::monotonic_now() - before, 3s); // 500 ms, and what a busy machine adds
    // When the call comes back, the device is closed and can be opened again.
    fake_.set(FakeDhdFate::stalled, false);
    for (int i = 0; i < 5000 && !device_; ++i) {
        if (auto again = device::dhd::open_dhd("4711", HAPNET_FAKE_DHD)) {
            device_ = *std::move(again);
        }
        pass(1ms);
    }
    EXPECT_TRUE(device_);
}

} // namespace
} // namespace hapnet::conformance
