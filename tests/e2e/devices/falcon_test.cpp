// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Two daemons, each with a Falcon of its own, play through the emulator. The Falcons are emulated:
// what is real is the daemons, libusb, and the network.
#include "proto/net/clock.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/peer.hpp"
#include "tests/support/falcon/fake_falcon.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <gtest/gtest.h>
#include <thread>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;
using device::falcon::Counts;

/// A Falcon on the bus of a testbed, and the person who holds it.
struct Held {
    Held(umockdev::Testbed& testbed, const std::string& serial, int address)
        : usb{testbed, test::usb_of_falcon(serial, address), falcon}
    {
        falcon.help_homing();
    }

    void want(double x_m)
    {
        usb.with_model([&] { falcon.want(base::Position{{x_m, 0.0, 0.0}}); });
    }
    void press(bool down) // the centre button
    {
        usb.with_model([&] { falcon.press(down ? 0x4 : 0); });
    }
    [[nodiscard]] std::vector<device::falcon::Command> commands()
    {
        return usb.with_model([&] { return falcon.commands(); });
    }
    [[nodiscard]] bool is_pushed()
    {
        const auto heard = commands();
        return !heard.empty() && heard.back().motors != Counts{};
    }
    /// Returns the force of the motors at the grip, to the right.
    [[nodiscard]] double push_n()
    {
        return usb.with_model([&] { return falcon.force().x(); });
    }
    [[nodiscard]] base::TimePoint last_push()
    {
        return usb.with_model([&] { return falcon.last_push(); });
    }

    test::FakeFalcon falcon{net::monotonic_now};
    umockdev::UsbDevice usb;
};

/// Both hands at the cube, from its two sides. A Falcon's motion is magnified twice: the cube
/// begins 10 mm from the middle of its workspace, and is touched from 12.5 mm on.
class TwoFalcons : public ::testing::Test {
protected:
    std::vector<std::string> options(const std::string& serial)
    {
        return {"--untested-device", "--device", "falcon:" + serial, "--task",         "T3",
                "--duration",        "120s",     "--control",        socket_of(serial)};
    }
    [[nodiscard]] std::string socket_of(const std::string& serial) const
    {
        return folder_.file(serial + ".sock");
    }

    /// Homes both and lets both hands press the cube between them.
    void press_together()
    {
        left_.want(-0.020);
        right_.want(0.020);
        ASSERT_TRUE(a_.says("session started"));
        ASSERT_TRUE(b_.says("session started"));
        ASSERT_TRUE(comes_true([&] { return is_homed(left_) && is_homed(right_); }));
        expect_to_hear(socket_of("LEFT"), 200);
        expect_to_hear(socket_of("RIGHT"), 200);
        left_.want(-0.009);
        right_.want(0.009);
        // The cube pushes each grip back to its own side.
        const auto is_felt = [&] { return left_.push_n() < -0.2 && right_.push_n() > 0.2; };
        const auto press = [&](bool down) {
            left_.press(down);
            right_.press(down);
        };
        const auto reach = [&, hand_m = 0.009]() mutable {
            hand_m = std::max(hand_m - 0.003, -0.02);
            if (left_.push_n() >= -0.2) left_.want(-hand_m);
            if (right_.push_n() <= 0.2) right_.want(hand_m);
        };
        ASSERT_TRUE(
            comes_to_be_felt({socket_of("LEFT"), socket_of("RIGHT")}, is_felt, press, reach))
            << left_.push_n() << " N, " << right_.push_n() << " N\n"
            << a_.process().err() << b_.process().err();
    }

    static bool is_homed(Held& held)
    {
        const auto heard = held.commands();
        return !heard.empty() && heard.back().lights != device::falcon::Lights::red;
    }

    TemporaryFolder folder_;
    umockdev::Testbed testbed_;
    Held left_{testbed_, "LEFT", 2};
    Held right_{testbed_, "RIGHT", 3};
    Emulator emulator_{{"--delay", "5ms"}};
    Peer a_{1, free_place(), emulator_.a().to_text(), options("LEFT")};
    Peer b_{2, free_place(), emulator_.b().to_text(), options("RIGHT")};
};

void expect_left_at_zero(Held& held)
{
    const auto heard = held.commands();
    ASSERT_GE(heard.size(), 3U);
    for (auto last = heard.end() - 3; last != heard.end(); ++last) {
        EXPECT_EQ(last->motors, Counts{});
    }
}

TEST_F(TwoFalcons, FeelEachOtherThroughTheCubeAndAreLeftAtZero)
{
    ASSERT_NO_FATAL_FAILURE(press_together());
    const std::size_t before = left_.commands().size();
    EXPECT_TRUE(comes_true([&] { return left_.commands().size() > before + 50; })); // it goes on
    b_.stop_on_a_busy_machine();
    expect_left_at_zero(right_);
    a_.stop_on_a_busy_machine();
    expect_left_at_zero(left_);

    for (Peer* peer : {&a_, &b_}) {
        EXPECT_EQ(peer->statistics()["messages"]["malformed"], 0);
        expect_the_same_forces_again(peer->record());
    }
}

TEST_F(TwoFalcons, OneFeelsNothing300MillisecondsAfterTheOtherWasKilled)
{
    ASSERT_NO_FATAL_FAILURE(press_together());
    const base::TimePoint killed = net::monotonic_now();
    a_.kill();
    std::this_thread::sleep_for(1s);
    EXPECT_FALSE(right_.is_pushed());
    // The last state arrives through the emulator 5 ms after the kill. The force then holds for 250
    // ms and fades within 50 ms. A late tick and its packet may add 25 ms on a busy machine.
    EXPECT_LE(right_.last_push() - killed, 330ms);
    EXPECT_GE(right_.last_push() - killed, -50ms); // it was pushed until then
    EXPECT_TRUE(b_.says("the other peer has been silent for 300 ms: force faded to zero"));
    b_.stop_on_a_busy_machine();
    expect_left_at_zero(right_);
    expect_the_same_forces_again(a_.record()); // up to its last written row
    expect_the_same_forces_again(b_.record());
}

TEST_F(TwoFalcons, OneThatIsToldToEndLeavesItsMotorsAtZero)
{
    ASSERT_NO_FATAL_FAILURE(press_together());
    a_.stop_on_a_busy_machine();
    expect_left_at_zero(left_);
    EXPECT_TRUE(b_.says("goodbye"));
    EXPECT_TRUE(comes_true([&] { return !right_.is_pushed(); }, 1s));
    b_.stop_on_a_busy_machine();
}

TEST_F(TwoFalcons, OneThatIsUnpluggedSaysSoAndTheOtherFeelsNothingOfIt)
{
    ASSERT_NO_FATAL_FAILURE(press_together());
    left_.usb.unplug();
    EXPECT_TRUE(a_.says("the device has gone"));
    a_.process().signal(SIGTERM); // it continues at zero force until then, and says so
    EXPECT_EQ(a_.process().wait_exit(30s), 1) << a_.process().err();
    b_.stop_on_a_busy_machine();
    expect_left_at_zero(right_);
    expect_the_same_forces_again(a_.record()); // the fault too
}

/// Expects that a daemon that cannot have its Falcon says why, and that the Falcon gets no torque.
void expect_refused(Held& held, const std::vector<std::string>& words)
{
    const Outcome outcome = run("hapnet-peer", {"--remote", free_place(), "--device", "falcon"});
    EXPECT_EQ(outcome.exit, 3) << outcome.err;
    for (const std::string& word : words) {
        EXPECT_NE(outcome.err.find(word), std::string::npos) << word << "\n" << outcome.err;
    }
    for (const auto& command : held.commands()) EXPECT_EQ(command.motors, Counts{});
}

TEST(FalconAtTheStart, WithoutFirmwareEndsTheDaemonWithTheCureAndIsToldNothing)
{
    umockdev::Testbed testbed;
    Held held{testbed, "FALC0001", 2};
    held.usb.with_model([&] { held.falcon.lose_firmware(); });
    expect_refused(held, {"--device falcon: ", "--falcon-firmware FILE"});
}

TEST(FalconAtTheStart, ThatAnotherDaemonHasEndsTheSecondOneWithTheCureAndTheFirstGoesOn)
{
    umockdev::Testbed testbed;
    Held held{testbed, "FALC0001", 2};
    Peer first{1, free_place(), free_place(), {"--untested-device", "--device", "falcon"}};
    expect_refused(held, {"--device falcon: ", "another program uses", "end that one first"});
    const std::size_t before = held.commands().size();
    EXPECT_TRUE(comes_true([&] { return held.commands().size() > before; }));
    first.stop();
    expect_left_at_zero(held);
}

} // namespace

} // namespace hapnet::e2e
