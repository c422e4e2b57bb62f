// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Requirements that must hold on a physical device before anyone holds it.
#include "device/hdapi/device_cycle.hpp"
#include "tests/conformance/hdapi/hdapi_test.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <atomic>
#include <future>
#include <vector>

namespace hapnet::conformance {
namespace {

using namespace std::chrono_literals;

const base::Force to_the_right{{1.0, 0.0, 0.0}};

bool is_push(const FakeHdCommand& command) { return command.motors_on; }

bool is_silent(const FakeHdCommand& command)
{
    const auto& force = command.force_n;
    return !command.motors_on && force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0;
}

class HdapiSafety : public Hdapi {
protected:
    /// Reads both devices for 300 ms, and returns for each whether it reported this fault.
    [[nodiscard]] std::vector<bool> have_been_at(device::Fault fault)
    {
        std::vector<bool> has(devices_.size(), false);
        for (int i = 0; i < 300; ++i) {
            for (std::size_t one = 0; one < has.size(); ++one) {
                has[one] = has[one] || device(one).read(net::monotonic_now()).fault == fault;
            }
            pass(1ms);
        }
        return has;
    }

    /// Pushes until the motors are on.
    void push()
    {
        for (int i = 0; i < 5000; ++i) {
            device().apply(device::ungoverned(to_the_right));
            pass(1ms);
            const auto commands = fake_.commands(0);
            if (!commands.empty() && is_push(commands.back())) return;
        }
        FAIL() << "the motors were never on";
    }
};

TEST_F(HdapiSafety, BlamesTheDeviceThatAnErrorNamesAndNotTheOneThatIsServedFirst)
{
    open({"Default Device", "Left"});
    for (int i = 0; i < 20; ++i) {
        fake_.complain(1, device::hdapi::error::warm_motors);
        pass(1ms);
    }
    EXPECT_EQ(have_been_at(device::Fault::overheat), (std::vector<bool>{false, true}));
    fake_.complain(0, device::hdapi::error::velocity_too_large);
    EXPECT_EQ(have_been_at(device::Fault::over_velocity), (std::vector<bool>{true, false}));
}

TEST_F(HdapiSafety, TellsAllOfAnErrorThatNamesNoneOfThem)
{
    open({"Default Device", "Left"});
    fake_.complain(99, device::hdapi::error::timer);
    EXPECT_EQ(have_been_at(device::Fault::timeout), (std::vector<bool>{true, true}));
}

TEST_F(HdapiSafety, TakesADeviceForGoneThatIsUnpluggedBesideAnotherThatPlaysOn)
{
    open({"Default Device", "Left"});
    fake_.set(1, FakeHdFate::unplugged, true);
    EXPECT_EQ(have_been_at(device::Fault::disconnected), (std::vector<bool>{false, true}));
}

TEST_F(HdapiSafety, EndsItsForceInTheVeryCycleThatFindsItUncalibrated)
{
    open();
    ASSERT_NO_FATAL_FAILURE(push());
    fake_.set(0, FakeHdFate::calibrated, false);
    const std::size_t first = fake_.commands(0).size();
    for (int i = 0; i < 5000 && fake_.commands(0).size() < first + 10; ++i) {
        device().apply(device::ungoverned(to_the_right));
        pass(1ms);
    }
    EXPECT_FALSE(device().read(net::monotonic_now()).calibrated);
    EXPECT_EQ(device().calibrate(net::monotonic_now()), device::CalibrationStep::dock_stylus);
    const auto commands = fake_.commands(0);
    ASSERT_GT(commands.size(), first + 2);
    // The frame that was open at that time may still contain it.
    const auto next = commands.begin() + static_cast<std::ptrdiff_t>(first) + 1;
    EXPECT_TRUE(std::all_of(next, commands.end(), is_silent));
}

TEST_F(HdapiSafety, LeavesTheMotorsOffFromTheFirstFrameOnUntilItIsToldAForce)
{
    open();
    pass(50ms);
    // The library's scheduler restarts, with the motors on, for another device.
    auto other = device::hdapi::open_hdapi("Left", HAPNET_FAKE_HD);
    ASSERT_TRUE(other);
    pass(50ms);
    for (const std::size_t one : {0U, 1U}) {
        const auto commands = fake_.commands(one);
        ASSERT_FALSE(commands.empty());
        EXPECT_TRUE(std::all_of(commands.begin(), commands.end(), is_silent));
    }
    ASSERT_NO_FATAL_FAILURE(push());
    const auto left = fake_.commands(1);
    EXPECT_TRUE(std::all_of(left.begin(), left.end(), is_silent));
}

TEST_F(HdapiSafety, IsAtZeroForceBeforeItsSchedulerStopsForAnother)
{
    open();
    ASSERT_NO_FATAL_FAILURE(push());
    std::atomic<bool> is_over{false};
    auto loop = std::async(std::launch::async, [&] {
        device().pace([&] {
            device().apply(device::ungoverned(to_the_right));
            return !is_over;
        });
    });
    const std::size_t first = frames_beyond(fake_.commands(0).size() + 20).size();
    auto other = device::hdapi::open_hdapi("Left", HAPNET_FAKE_HD);
    ASSERT_TRUE(other);
    const auto commands = frames_beyond(fake_.commands(0).size() + 20);
    is_over = true;
    loop.get();
    const auto from = commands.begin() + static_cast<std::ptrdiff_t>(first);
    const auto silent = std::search_n(from, commands.end(), 3, true,
                                      [](const FakeHdCommand& it, bool) { return is_silent(it); });
    ASSERT_NE(silent, commands.end());
    EXPECT_TRUE(std::any_of(from - 10, from, is_push));
    EXPECT_TRUE(std::any_of(silent, commands.end(), is_push)); // and it plays on
}

TEST_F(HdapiSafety, LetsGoAtAWordFromAnotherThreadWhileTheLoopHangs)
{
    open();
    std::promise<void> hangs;
    std::promise<void> release;
    std::atomic<int> beats{0};
    auto loop = std::async(std::launch::async, [&] {
        device().pace([&] {
            device().apply(device::ungoverned(to_the_right));
            if (++beats < 20) return true;
            hangs.set_value();
            release.get_future().wait();
            return false;
        });
    });
    hangs.get_future().wait();
    device().halt();
    const std::size_t first = fake_.commands(0).size();
    const auto commands = frames_beyond(first + 10);
    release.set_value();
    loop.get();
    ASSERT_GT(commands.size(), first + 2); // the library goes on
    const auto next = commands.begin() + static_cast<std::ptrdiff_t>(first) + 1;
    EXPECT_TRUE(std::all_of(next, commands.end(), is_silent));
}

TEST_F(HdapiSafety, LetsGoByItselfOfALoopThatHangs)
{
    open();
    std::promise<void> hangs;
    std::promise<void> release;
    auto loop = std::async(std::launch::async, [&] {
        device().pace([&] {
            device().apply(device::ungoverned(to_the_right));
            hangs.set_value();
            release.get_future().wait();
            return false;
        });
    });
    hangs.get_future().wait();
    const std::size_t first = fake_.commands(0).size();
    const std::size_t over = first + device::hdapi::DeviceCycle::stale_after_cycles + 1;
    const auto commands = frames_beyond(over + 10);
    release.set_value();
    loop.get();
    ASSERT_GT(commands.size(), over);
    const auto next = commands.begin() + static_cast<std::ptrdiff_t>(over);
    EXPECT_TRUE(std::all_of(next, commands.end(), is_silent));
}

} // namespace
} // namespace hapnet::conformance
