// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/force_gate.hpp"

#include "peer/loop/watched_rig.hpp"

#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <memory>

namespace hapnet::peer::loop {
namespace {

using namespace std::chrono_literals;

/// A device with the test's buttons, and its last force.
class ButtonDevice final : public device::Device {
public:
    [[nodiscard]] const device::Identity& identity() const override { return identity_; }
    [[nodiscard]] const device::Capabilities& capabilities() const override { return can_; }
    [[nodiscard]] device::Sample read(base::TimePoint /*now*/) override
    {
        ++sample.sequence;
        return sample;
    }
    void apply(const device::GovernedForce& force) override { told = force; }
    void halt() noexcept override { told = {}; }

    device::Sample sample;
    device::GovernedForce told;

private:
    device::Identity identity_{};
    device::Capabilities can_{.force_max_n = 3.3};
};

/// The path of a force of 1 N to the right through a loop, without the rest of the loop.
struct Loop {
    explicit Loop(DeadMan dead_man = {}) : gate{stop, std::move(dead_man)} {}

    /// Plays one tick. Returns the force that the device gets.
    double tick()
    {
        now += 1ms;
        WatchedRig watched{rig, watchdog, &gate};
        std::ignore = watched.read(now);
        told = watched.apply(base::Force{{1.0, 0.0, 0.0}}, true, now);
        state = watched.governor_state();
        return base::norm(device().told.force());
    }
    double run_for(base::Duration duration)
    {
        double force = 0.0;
        for (const auto end = now + duration; now < end;) force = tick();
        return force;
    }
    ButtonDevice& device() { return dynamic_cast<ButtonDevice&>(rig.device()); }

    net::StopSignal stop;
    device::Rig rig{std::make_unique<ButtonDevice>(), device::GovernorLimits{}};
    Watchdog watchdog{rig.device()};
    ForceGate gate;
    base::TimePoint now{1h};
    base::Force told;
    device::GovernorState state = device::GovernorState::off;
};

TEST(ForceGate, ClosesInTheTickAfterASignal)
{
    Loop loop;
    EXPECT_GT(loop.run_for(2s), 0.9);
    std::raise(SIGTERM);
    EXPECT_EQ(loop.tick(), 0.0);
    EXPECT_FALSE(loop.device().told.motors_on());
    EXPECT_EQ(loop.told, base::Force{}) << "and the record says so";
    EXPECT_EQ(loop.state, device::GovernorState::withheld);
    EXPECT_EQ(loop.run_for(2s), 0.0);
}

TEST(ForceGate, LatchesAnEmergencyStop)
{
    Loop loop;
    EXPECT_GT(loop.run_for(2s), 0.9);
    loop.gate.stop_in_emergency();
    EXPECT_EQ(loop.tick(), 0.0);
    for (int press = 0; press < 5; ++press) { // what ends a fault does not end it
        ++loop.device().sample.presses;
        loop.device().sample.docked = press % 2 == 0;
        EXPECT_EQ(loop.run_for(2s), 0.0);
    }
    EXPECT_FALSE(loop.gate.is_stopping()) << "the session goes on without force";
}

TEST(ForceGate, OpensOnlyWhileADeviceButtonIsHeld)
{
    Loop loop{DeadMan{DeviceButton{}}};
    EXPECT_EQ(loop.run_for(2s), 0.0);
    loop.device().sample.buttons = 2;
    EXPECT_LT(loop.run_for(50ms), 0.1); // ramps in
    EXPECT_GT(loop.run_for(2s), 0.9);
    loop.device().sample.buttons = 0;
    EXPECT_EQ(loop.tick(), 0.0);
    EXPECT_EQ(loop.state, device::GovernorState::withheld);
    loop.device().sample.buttons = 1;
    loop.device().sample.fault = device::Fault::none;
    double most = 0.0;
    for (int ms = 0; ms < 100; ++ms) most = std::max(most, loop.tick());
    EXPECT_LT(most, 0.1) << "a moment's release does not make the force jump back";
    EXPECT_GT(loop.run_for(2s), 0.9);
    loop.device().sample.fault = device::Fault::timeout; // the button's state is unknown
    EXPECT_EQ(loop.tick(), 0.0);
}

TEST(KeysDown, AreHeldFromThePressToTheRelease)
{
    KeysDown keys;
    const auto happens = [&](std::uint16_t type, std::uint16_t code, int value) {
        input_event event{};
        event.type = type;
        event.code = code;
        event.value = value;
        return keys.on_events({&event, 1});
    };
    EXPECT_FALSE(keys.any());
    EXPECT_TRUE(happens(EV_KEY, KEY_B, 1));
    EXPECT_TRUE(keys.any());
    EXPECT_TRUE(happens(EV_KEY, KEY_B, 2)); // repeats itself
    EXPECT_TRUE(happens(EV_KEY, KEY_C, 1));
    EXPECT_TRUE(happens(EV_KEY, KEY_B, 0));
    EXPECT_TRUE(keys.any());
    EXPECT_TRUE(happens(EV_KEY, KEY_C, 0));
    EXPECT_FALSE(keys.any());
    EXPECT_TRUE(happens(EV_REL, REL_X, 1)); // no key
    EXPECT_TRUE(happens(EV_KEY, 0xffff, 1));
    EXPECT_FALSE(keys.any());
    EXPECT_FALSE(happens(EV_SYN, SYN_DROPPED, 0));
    std::array<unsigned char, KEY_CNT / 8> bits{};
    bits[KEY_B / 8] = 1U << (KEY_B % 8);
    keys.set(bits);
    EXPECT_TRUE(keys.any());
    EXPECT_TRUE(happens(EV_KEY, KEY_B, 0));
    EXPECT_FALSE(keys.any());
}

TEST(EvdevSwitch, RefusesWhatIsNoInputDevice)
{
    for (const char* path : {"/dev/null", "/no/such/device"}) {
        try {
            const EvdevSwitch input{path};
            FAIL() << path;
        } catch (const std::system_error& error) {
            EXPECT_NE(std::string{error.what()}.find(path), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace hapnet::peer::loop
