// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A daemon with a force-feedback joystick plays with a simulated hand. The joystick is emulated:
// what is real is the daemons, hidapi, and the network.
#include "proto/net/clock.hpp"
#include "tests/conformance/hid/emulated.hpp"
#include "tests/e2e/peer.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <gtest/gtest.h>
#include <thread>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// A joystick on the bus of a testbed, and the hand that holds it; both live in real time.
class HeldJoystick {
public:
    HeldJoystick()
    {
        life_ = std::thread{[this] {
            base::TimePoint last = net::monotonic_now();
            while (!over_) {
                std::this_thread::sleep_for(1ms);
                const base::TimePoint now = net::monotonic_now();
                // After a delay of the machine, hand and joystick continue from where they were. To
                // make up for the delay at once would be faster than any hand.
                const base::Duration passed = std::min<base::Duration>(now - last, 2ms);
                const double step_m = speed_m_per_s * base::to_seconds(passed);
                aim_m_ += std::clamp(wanted_m_ - aim_m_, -step_m, step_m);
                pid_.with([&](hid_double::FakePid& pid) { pid.want(aim_m_); });
                pid_.pass(passed);
                last = now;
            }
        }};
    }
    ~HeldJoystick()
    {
        over_ = true;
        life_.join();
    }
    HeldJoystick(const HeldJoystick&) = delete;
    HeldJoystick& operator=(const HeldJoystick&) = delete;

    /// Moves there slowly, because a jump would be a fault.
    void want(double right_m) { wanted_m_ = right_m; }
    void reach_further() { want(std::min(wanted_m_ + 0.01, 0.07)); }
    void press(bool down)
    {
        pid_.with([&](hid_double::FakePid& pid) { pid.press(down); });
    }
    [[nodiscard]] double push_n() // to the right
    {
        return pid_.with([](const hid_double::FakePid& pid) { return pid.push().force_n[0]; });
    }
    [[nodiscard]] std::vector<hid_double::Push> pushes()
    {
        return pid_.with([](const hid_double::FakePid& pid) { return pid.pushes(); });
    }
    [[nodiscard]] bool is_where_it_wants_to_be()
    {
        return pid_.with([&](const hid_double::FakePid& pid) {
            return std::abs(pid.grip()[0] - wanted_m_) < 0.005;
        });
    }
    void unplug() { pid_.hidraw().unplug(); }

private:
    static constexpr double speed_m_per_s = 0.1;

    umockdev::Testbed testbed_;
    conformance::EmulatedPid pid_{testbed_};
    std::atomic<double> wanted_m_{-0.05}; // left of the cube
    double aim_m_ = 0.0;
    std::atomic<bool> over_{false};
    std::thread life_;
};

/// The joystick's hand comes from the left, the simulated hand from the right. The joystick's 160
/// mm are not magnified: it touches the cube from 25 mm left of the middle on.
class JoystickSession : public ::testing::Test {
protected:
    void press_together()
    {
        ASSERT_TRUE(comes_true([&] { return joystick_.is_where_it_wants_to_be(); }));
        ASSERT_TRUE(a_.says("session started"));
        expect_to_hear(socket_, 200);
        joystick_.want(-0.015);
        feel_each_other();
    }

    void feel_each_other()
    {
        const std::size_t before = joystick_.pushes().size();
        const auto is_felt = [&] {
            return joystick_.push_n() <= felt_n && joystick_.pushes().size() > before + 50;
        };
        ASSERT_TRUE(comes_to_be_felt(
            {socket_}, is_felt, [&](bool down) { joystick_.press(down); },
            [&] { joystick_.reach_further(); }))
            << joystick_.push_n() << " N\n"
            << a_.process().err();
    }

    /// Stops both programs for longer than the governor tolerates. True if the joystick was
    /// pushing.
    [[nodiscard]] bool stands_still_under_force()
    {
        for (Peer* peer : {&a_, &b_}) peer->process().pause();
        const bool pushes = joystick_.push_n() <= felt_n;
        std::this_thread::sleep_for(150ms);
        for (Peer* peer : {&a_, &b_}) peer->process().signal(SIGCONT);
        return pushes;
    }

    static constexpr double felt_n = -0.2;

    TemporaryFolder folder_;
    std::string socket_ = folder_.file("peer.sock");
    HeldJoystick joystick_;
    std::string place_ = free_place();
    Peer b_{2, free_place(), place_, {"--task", "T3", "--duration", "120s"}};
    Peer a_{1,
            place_,
            b_.listen(),
            {"--untested-device", "--device", "hid:FFB0001", "--hid-force", "8N", "--force-limit",
             "500mN", "--task", "T3", "--duration", "120s", "--control", socket_}};
};

TEST_F(JoystickSession, EndsAtZeroAndItsForcesCanBeLivedThroughAgain)
{
    ASSERT_NO_FATAL_FAILURE(press_together());
    a_.stop_on_a_busy_machine();
    b_.stop_on_a_busy_machine();
    const auto pushes = joystick_.pushes();
    ASSERT_GE(pushes.size(), 3U);
    EXPECT_TRUE(std::all_of(pushes.end() - 3, pushes.end(),
                            [](const hid_double::Push& push) { return push.is_zero(); }));
    expect_the_same_forces_again(a_.record());
    expect_the_same_forces_again(b_.record());
}

/// Stops the programs, as a busy machine does.
TEST_F(JoystickSession, ThatStandsStillUnderForceCanBeLivedThroughAgain)
{
    ASSERT_NO_FATAL_FAILURE(press_together());
    const auto is_at_fault = [&] { return fault_at(socket_) == "timeout"; };
    // A joystick that the machine delays is silent, and then there is no force to stop.
    ASSERT_TRUE(comes_true([&] { return stands_still_under_force() || is_at_fault(); }));
    EXPECT_TRUE(comes_true(is_at_fault));
    ASSERT_NO_FATAL_FAILURE(feel_each_other());
    a_.stop_on_a_busy_machine();
    b_.stop_on_a_busy_machine();
    expect_the_same_forces_again(a_.record());
    expect_the_same_forces_again(b_.record());
}

TEST_F(JoystickSession, ThatLosesItsDeviceSaysSoAndCanBeLivedThroughAgainWithItsFault)
{
    ASSERT_NO_FATAL_FAILURE(press_together());
    joystick_.unplug();
    EXPECT_TRUE(a_.says("the device has gone"));
    a_.process().signal(SIGTERM);
    EXPECT_EQ(a_.process().wait_exit(30s), 1) << a_.process().err();
    b_.stop_on_a_busy_machine();
    expect_the_same_forces_again(a_.record());
}

} // namespace

} // namespace hapnet::e2e
