// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Tests of devices behind a library with a scheduler of its own.
#include "device/hdapi/transport/hdapis.hpp"
#include "tests/conformance/hdapi/hdapi_test.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <gtest/gtest.h>
#include <stdexcept>

namespace hapnet::conformance {
namespace {

using namespace std::chrono_literals;

const base::Force along_x{{1.0, 0.0, 0.0}};

void expect_words(const std::string& text, const std::vector<std::string>& words)
{
    for (const std::string& word : words) {
        EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
    }
}

TEST_F(Hdapi, SaysWhichLibraryIsMissingAndWhatToDo)
{
    const auto none = device::hdapi::open_hdapi("", "/no/such/libHD.so");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, device::Fault::library_missing);
    expect_words(none.error().message, {"/no/such/libHD.so", "OpenHaptics", "--hd-library"});
}

TEST_F(Hdapi, SaysWhichFunctionALibraryLacks)
{
    const auto none = device::hdapi::open_hdapi("", HAPNET_FAKE_HD_WITHOUT_SCHEDULER);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, device::Fault::library_missing);
    expect_words(none.error().message, {"without_scheduler", "hdDisableDevice()"});
}

TEST_F(Hdapi, ListsADeviceWhoseLibraryCannotBeLoadedWithTheReason)
{
    const auto found = device::hdapi::find_hdapis("/no/such/libHD.so");
    ASSERT_FALSE(found.empty());
    for (const device::Found& one : found) {
        ASSERT_TRUE(one.unusable);
        EXPECT_EQ(one.unusable->fault, device::Fault::library_missing);
        EXPECT_EQ(one.identity.note, device::never_run);
    }
    EXPECT_FALSE(device::hdapi::find_hdapis(HAPNET_FAKE_HD).at(0).unusable);
}

TEST_F(Hdapi, SaysOfANameThatTheLibraryDoesNotKnowHowToFindTheRightOne)
{
    const auto none = device::hdapi::open_hdapi("Rigth", HAPNET_FAKE_HD);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, device::Fault::not_found);
    EXPECT_EQ(none.error().code, 0x302);
    expect_words(none.error().message, {"'Rigth'", "0x302", "Touch_HeadlessSetup",
                                        "Default PHANToM", "hapnet-peer doctor"});
}

TEST_F(Hdapi, OpensAllOfSeveralOrNone)
{
    const auto none = device::hdapi::open_hdapis({"Left", "Rigth"}, HAPNET_FAKE_HD);
    ASSERT_FALSE(none);
    open({"Left"});
    EXPECT_TRUE(read_until([](const auto& sample) { return sample.sequence > 0; }));
}

TEST_F(Hdapi, TellsTwoDevicesOfOneProcessEachItsOwnForce)
{
    open({"Default Device", "Left"});
    for (int i = 0; i < 100; ++i) {
        device(0).apply(device::ungoverned(along_x));
        device(1).apply(device::ungoverned({{0.0, 0.5, 0.0}}));
        pass(1ms);
    }
    const auto mine = fake_.commands(0);
    const auto left = fake_.commands(1);
    devices_.clear();
    const auto pushed = [](const auto& commands, double x, double y) {
        return std::any_of(commands.begin(), commands.end(), [&](const FakeHdCommand& it) {
            return it.motors_on && it.force_n[0] == x && it.force_n[1] == y;
        });
    };
    EXPECT_TRUE(pushed(mine, 1.0, 0.0));
    EXPECT_FALSE(pushed(mine, 0.0, 0.5));
    EXPECT_TRUE(pushed(left, 0.0, 0.5));
}

TEST_F(Hdapi, ReportsAnErrorOfOneFrameOnceAndGoesOn)
{
    open();
    ASSERT_TRUE(read_until([](const auto& sample) { return sample.sequence > 0; }));
    fake_.fail_frame(0, 5);
    EXPECT_TRUE(read_until(
        [](const auto& sample) { return sample.fault == device::Fault::communication; }));
    EXPECT_TRUE(read_until([](const auto& sample) { return sample.fault == device::Fault::none; }));
}

TEST_F(Hdapi, CallsWarmMotorsAnOverheat)
{
    open();
    fake_.set(0, FakeHdFate::warm, true);
    EXPECT_TRUE(
        read_until([](const auto& sample) { return sample.fault == device::Fault::overheat; }));
}

TEST_F(Hdapi, DropsAForceThatNobodyRepeats)
{
    open();
    for (int i = 0; i < 20; ++i) {
        device().apply(device::ungoverned(along_x));
        pass(1ms);
    }
    pass(200ms); // 20 cycles of the library, and what a busy machine adds
    const FakeHdCommand last = fake_.commands(0).back();
    EXPECT_EQ(last.force_n[0], 0.0);
    EXPECT_FALSE(last.motors_on);
}

TEST_F(Hdapi, CountsAPressOfTheButtonThatIsDebounced)
{
    open();
    fake_.set(0, FakeHdFate::pressed, true);
    EXPECT_TRUE(read_until([](const auto& sample) { return sample.gripping; }));
    EXPECT_EQ(device().read(net::monotonic_now()).presses, 1);
}

TEST_F(Hdapi, SetsTheBeatOfALoopThatItPacesAndTakesEachForceInTheSameFrameIfItComesInTime)
{
    open();
    std::vector<std::uint64_t> cycles; // of the library: one frame each
    const auto force_of_beat = [](std::size_t beat) { return 0.001 * static_cast<double>(beat); };
    device().pace([&] {
        const auto sample = device().read(net::monotonic_now());
        if (!cycles.empty()) {
            EXPECT_GT(sample.sequence, cycles.back()); // never the same word twice
        }
        cycles.push_back(sample.sequence);
        device().apply(device::ungoverned({{force_of_beat(cycles.size()), 0.0, 0.0}}));
        return cycles.size() < 100;
    });
    ASSERT_EQ(cycles.size(), 100U);
    const auto commands = frames_beyond(cycles.back() + 1); // a late one comes with the next
    const auto is_force_of = [&](std::size_t beat) {
        return [x = force_of_beat(beat)](const FakeHdCommand& it) { return it.force_n[0] == x; };
    };
    EXPECT_TRUE(std::any_of(commands.begin(), commands.end(), is_force_of(cycles.size())));
    int in_time = 0;
    for (std::size_t beat = 1; beat <= cycles.size(); ++beat) {
        const auto frame = static_cast<std::size_t>(cycles[beat - 1]) - 1;
        if (frame < commands.size() && is_force_of(beat)(commands[frame])) ++in_time;
    }
    std::printf("%d of 100 forces in the frame of their beat\n", in_time);
    EXPECT_GE(in_time, 1); // on a loaded machine 98 and 99
}

TEST_F(Hdapi, GivesTheLoopBackWhenTheSchedulerStalls)
{
    open();
    std::atomic<int> beats{0};
    device().pace([&] {
        if (++beats == 10) fake_.set(0, FakeHdFate::stalled, true);
        return true;
    });
    EXPECT_EQ(beats, 10);
    EXPECT_TRUE(
        read_until([](const auto& sample) { return sample.fault == device::Fault::timeout; }));
    fake_.set(0, FakeHdFate::stalled, false);
    EXPECT_TRUE(read_until([](const auto& sample) { return sample.fault == device::Fault::none; }));
    EXPECT_EQ(beats, 10); // no beat is called any more
}

TEST_F(Hdapi, LetsAnExceptionOfTheLoopOutOnTheThreadThatPaces)
{
    open();
    EXPECT_THROW(device().pace([]() -> bool { throw std::runtime_error{"in the servo"}; }),
                 std::runtime_error);
    EXPECT_TRUE(read_until([](const auto& sample) { return sample.sequence > 2; }));
}

TEST_F(Hdapi, EndsWhenTheSchedulerHasStalledForGood)
{
    open();
    device().apply(device::ungoverned(along_x));
    pass(20ms);
    fake_.set(0, FakeHdFate::stalled, true);
    const auto before = net::monotonic_now();
    devices_.clear();
    EXPECT_LT(net::monotonic_now() - before, 2s); // 100 ms, and what a busy machine adds
    fake_.set(0, FakeHdFate::stalled, false);
}

} // namespace
} // namespace hapnet::conformance
