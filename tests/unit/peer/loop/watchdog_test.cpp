// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/watchdog.hpp"
#include "proto/net/clock.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <semaphore>
#include <thread>

namespace hapnet::peer::loop {
namespace {

using namespace std::chrono_literals;

/// A device whose apply() hangs until it is released.
class HangingDevice final : public device::Device {
public:
    [[nodiscard]] const device::Identity& identity() const override { return identity_; }
    [[nodiscard]] const device::Capabilities& capabilities() const override { return can_; }
    [[nodiscard]] device::Sample read(base::TimePoint /*now*/) override { return {}; }
    void apply(const device::GovernedForce& /*force*/) override { let_go_.acquire(); }
    void halt() noexcept override { halts_.release(); }

    void let_go() { let_go_.release(); }
    /// Waits for `times` more calls of halt(). Returns false when they do not come.
    [[nodiscard]] bool is_halted(int times)
    {
        for (int i = 0; i < times; ++i) {
            if (!halts_.try_acquire_for(10s)) return false;
        }
        return true;
    }
    [[nodiscard]] bool was_halted() { return halts_.try_acquire(); }

private:
    device::Identity identity_;
    device::Capabilities can_;
    std::binary_semaphore let_go_{0};
    std::counting_semaphore<> halts_{0};
};

TEST(Alarm, RisesAfterTwentyMillisecondsAndBecomesAFaultAfterAHundred)
{
    EXPECT_EQ(alarm_after(0ms), Alarm::none);
    EXPECT_EQ(alarm_after(20ms), Alarm::none);
    EXPECT_EQ(alarm_after(20ms + 1ns), Alarm::halt);
    EXPECT_EQ(alarm_after(100ms), Alarm::halt);
    EXPECT_EQ(alarm_after(100ms + 1ns), Alarm::fault);
}

TEST(Watchdog, LetsGoOfADeviceInWhoseApplyTheLoopHangs)
{
    HangingDevice device;
    Watchdog watchdog{device};
    const base::TimePoint begin = net::monotonic_now();
    std::thread loop{[&] {
        watchdog.beat(net::monotonic_now());
        device.apply({});
        watchdog.rest();
    }};
    EXPECT_TRUE(device.is_halted(3)); // repeatedly, because a command may be lost
    EXPECT_GE(net::monotonic_now() - begin, 20ms + 2 * Watchdog::halt_every);
    EXPECT_EQ(watchdog.halts(), 1U);
    bool is_fault = false;
    while (!is_fault && device.is_halted(1)) is_fault = watchdog.take_fault();
    EXPECT_TRUE(is_fault);
    EXPECT_GT(net::monotonic_now() - begin, 100ms);
    EXPECT_TRUE(device.is_halted(3));
    EXPECT_FALSE(watchdog.take_fault()); // reported once
    EXPECT_EQ(watchdog.halts(), 1U);     // one silence
    device.let_go();
    loop.join();
}

TEST(Watchdog, LeavesALoopAloneThatHasNotBegunOrHasEnded)
{
    HangingDevice device;
    {
        Watchdog watchdog{device};
        watchdog.beat(net::monotonic_now());
        watchdog.rest();
    } // the destructor waits for the next look
    EXPECT_FALSE(device.was_halted());
}

TEST(Watchdog, NoticesTheNextSilenceAsWell)
{
    HangingDevice device;
    Watchdog watchdog{device};
    watchdog.beat(net::monotonic_now());
    EXPECT_TRUE(device.is_halted(1));
    watchdog.rest();
    // Waits until it has looked again, and seen the rest.
    net::sleep_until(net::monotonic_now() + 2 * Watchdog::halt_after);
    while (device.was_halted()) {}
    watchdog.beat(net::monotonic_now());
    EXPECT_TRUE(device.is_halted(1));
    EXPECT_EQ(watchdog.halts(), 2U);
}

} // namespace
} // namespace hapnet::peer::loop
