// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Tests of the FireWire Omni besides the suite.
#include "device/omni1394/transport/omni1394s.hpp"
#include "tests/support/device/ungoverned.hpp"
#include "tests/support/omni1394/firewire_omni.hpp"

#include <chrono>
#include <cstdlib>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hapnet::device::omni1394 {
namespace {

using namespace std::chrono_literals;

/// Drops the privileges of root while it exists, because root may open every file. Others cannot
/// open a file of mode 0, not even their own.
class Unprivileged {
public:
    Unprivileged()
    {
        if (was_ == 0 && seteuid(nobody) != 0) std::abort();
    }
    ~Unprivileged()
    {
        if (was_ == 0 && seteuid(was_) != 0) std::abort();
    }
    Unprivileged(const Unprivileged&) = delete;
    Unprivileged& operator=(const Unprivileged&) = delete;

private:
    static constexpr uid_t nobody = 65534;
    uid_t was_ = geteuid();
};

/// A testbed with an Omni, driven each millisecond.
struct OverTheBus : ::testing::Test {
    void open(const Options& options)
    {
        auto opened = open_omni("", options);
        ASSERT_TRUE(opened.has_value()) << opened.error().message;
        device = *std::move(opened);
    }
    void play_for(base::Duration time, const glm::dvec3& newtons = {})
    {
        for (const base::TimePoint end = now + time; now < end;) {
            now += 1ms;
            omni.live(1);
            sample = device->read(now);
            device->apply(ungoverned({newtons}));
        }
    }
    /// Calibrates the device, and moves it to the middle of the workspace.
    void take_out()
    {
        play_for(60ms);
        omni.with_omni([](FakeOmni& fake) { fake.lead_to({}); });
        omni.live(1500);
        play_for(20ms);
    }
    [[nodiscard]] std::vector<std::optional<HostPacket>> heard()
    {
        return omni.with_omni([](const FakeOmni& fake) { return fake.heard(); });
    }
    [[nodiscard]] bool was_ever_pushed()
    {
        for (const auto& packet : heard()) {
            if (!packet || packet->motors != glm::ivec3{0} || packet->motors_on) return true;
        }
        return false;
    }
    /// Expects zeros and motors off in the last eight packets, which are a millisecond.
    void expect_zeros()
    {
        const auto packets = heard();
        ASSERT_GE(packets.size(), 8U);
        for (std::size_t i = packets.size() - 8; i < packets.size(); ++i) {
            ASSERT_TRUE(packets[i].has_value());
            EXPECT_EQ(packets[i]->motors, glm::ivec3{0});
            EXPECT_FALSE(packets[i]->motors_on);
        }
    }

    umockdev::Testbed testbed;
    FirewireOmni omni{testbed, 1, FakeOmni{}};
    std::unique_ptr<Device> device;
    base::TimePoint now{1h};
    Sample sample;
};

const Options with_force{.profile = "", .uncalibrated_force = true};

TEST_F(OverTheBus, IsFoundBySerialAndSaidToBeUntried)
{
    const auto found = find_omnis();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].identity.serial, "70427300007");
    EXPECT_EQ(found[0].identity.note, never_run);
    EXPECT_FALSE(found[0].unusable);
    EXPECT_TRUE(open_omni("0x000b990082b69801", {}).has_value());
    const auto other = open_omni("12345678901", {});
    ASSERT_FALSE(other.has_value());
    EXPECT_EQ(other.error().fault, Fault::not_found);
    EXPECT_NE(other.error().message.find("12345678901"), std::string::npos);
}

TEST_F(OverTheBus, IsFoundAgainOnceItIsPluggedIn)
{
    omni.unplug();
    EXPECT_TRUE(find_omnis().empty());
    omni.plug_in();
    const auto found = find_omnis();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].identity.serial, "70427300007");
    if (found[0].unusable) FAIL() << found[0].unusable->message;
}

TEST_F(OverTheBus, IsListedWithTheCureWhereThereIsNoPermission)
{
    chmod(testbed.real_path("").c_str(), 0755);
    chmod(testbed.real_path("/dev/fw1").c_str(), 0);
    chmod(testbed.real_path("/ioctl/dev/fw1").c_str(), 0777); // umockdev's own
    const Unprivileged unprivileged;
    const auto found = find_omnis();
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].unusable);
    EXPECT_EQ(found[0].identity.serial, "0x000b990082b69801");
    EXPECT_EQ(found[0].unusable->fault, Fault::permission);
    EXPECT_NE(found[0].unusable->message.find("udev"), std::string::npos);
    const auto opened = open_omni("", {});
    ASSERT_FALSE(opened.has_value());
    EXPECT_EQ(opened.error().fault, Fault::permission);
}

TEST_F(OverTheBus, IsListedAsInUseWhileItIsOpen)
{
    open({});
    const auto found = find_omnis();
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].unusable);
    EXPECT_EQ(found[0].unusable->fault, Fault::in_use);
    device.reset();
    EXPECT_FALSE(find_omnis()[0].unusable);
}

TEST_F(OverTheBus, IsNotOpenedWhereItRefusesToAnswer)
{
    omni.refuse(true);
    ASSERT_EQ(find_omnis().size(), 1U);
    EXPECT_TRUE(find_omnis()[0].unusable);
    const auto opened = open_omni("", {});
    ASSERT_FALSE(opened.has_value());
    EXPECT_EQ(opened.error().fault, Fault::communication);
}

TEST_F(OverTheBus, SendsNothingButZerosWithTheMotorsOffReadOnly)
{
    open({});
    EXPECT_EQ(device->capabilities().axes_out, 0);
    take_out();
    play_for(100ms, {1.0, 1.0, 1.0});
    EXPECT_TRUE(sample.calibrated);
    EXPECT_GT(heard().size(), 500U);
    EXPECT_FALSE(was_ever_pushed());
}

TEST_F(OverTheBus, SendsAtMostAQuarterUncalibrated)
{
    open(with_force);
    take_out();
    play_for(100ms, {3.3, 3.3, -3.3});
    EXPECT_TRUE(was_ever_pushed());
    for (const auto& packet : heard()) {
        ASSERT_TRUE(packet.has_value());
        for (const int joint : {0, 1, 2}) ASSERT_LE(std::abs(packet->motors[joint]), 511);
    }
}

TEST_F(OverTheBus, ReadsItsTorquesFromAFileAndSaysWhereThatIsWrong)
{
    const auto opened = open_omni("", {.profile = "/nowhere/omni.toml"});
    ASSERT_FALSE(opened.has_value());
    EXPECT_EQ(opened.error().message.substr(0, 18), "/nowhere/omni.toml");
}

TEST_F(OverTheBus, UndockedAtTheStartIsNotCalibratedAndGetsNoForce)
{
    omni.with_omni([](FakeOmni& fake) { fake = FakeOmni{false}; });
    open(with_force);
    play_for(200ms, {1.0, 0.0, 0.0});
    EXPECT_FALSE(sample.calibrated);
    EXPECT_EQ(device->calibrate(now), CalibrationStep::dock_stylus);
    EXPECT_FALSE(was_ever_pushed());
}

TEST_F(OverTheBus, IsLeftAtZeroByABusResetFromTheNextTickOnUntilItIsDocked)
{
    open(with_force);
    take_out();
    play_for(20ms, {0.5, 0.0, 0.0});
    ASSERT_TRUE(heard().back()->motors_on);
    omni.reset_bus();
    play_for(5ms, {0.5, 0.0, 0.0}); // one tick, and what was on its way
    EXPECT_EQ(sample.fault, Fault::not_calibrated);
    EXPECT_FALSE(sample.calibrated);
    expect_zeros();
    omni.with_omni([](FakeOmni& fake) { fake.lead_to(omni::position_of(omni::inkwell_pose)); });
    play_for(1200ms);
    EXPECT_EQ(sample.fault, Fault::none);
    device.reset(); // with the new generation of addresses
    EXPECT_FALSE(omni.with_omni([](const FakeOmni& fake) { return fake.is_streaming(); }));
}

TEST_F(OverTheBus, IsLeftAtZeroWhenItLosesItsCalibration)
{
    open(with_force);
    take_out();
    play_for(20ms, {0.5, 0.0, 0.0});
    omni.with_omni([](FakeOmni& fake) { fake.jump({300, 0, 0}); });
    play_for(5ms, {0.5, 0.0, 0.0});
    EXPECT_EQ(sample.fault, Fault::not_calibrated);
    EXPECT_FALSE(sample.calibrated);
    expect_zeros();
}

TEST_F(OverTheBus, IsLeftAtZeroWhenItTalksNonsense)
{
    open(with_force);
    take_out();
    play_for(20ms, {0.5, 0.0, 0.0});
    omni.with_omni([](FakeOmni& fake) { fake.garble(true); });
    play_for(25ms, {0.5, 0.0, 0.0});
    EXPECT_EQ(sample.fault, Fault::communication);
    expect_zeros();
}

TEST_F(OverTheBus, FallsSilentWithinTwoMillisecondsWhereTheLoopStandsStill)
{
    open(with_force);
    take_out();
    play_for(20ms, {0.5, 0.0, 0.0});
    omni.live(10);
    const std::size_t told = heard().size();
    omni.live(100);
    EXPECT_EQ(heard().size(), told);
    device->halt(); // a watchdog
    omni.live(2);
    expect_zeros();
}

TEST_F(OverTheBus, IsToldToStopStreamingAtTheEnd)
{
    open(with_force);
    take_out();
    play_for(20ms, {0.5, 0.0, 0.0});
    device.reset();
    expect_zeros();
    EXPECT_FALSE(omni.with_omni([](const FakeOmni& fake) { return fake.is_streaming(); }));
    EXPECT_EQ(omni.with_omni([](const FakeOmni& fake) { return fake.written().back(); }), 0x1087U);
}

TEST_F(OverTheBus, SetsTheRhythm)
{
    open({});
    ASSERT_EQ(device->capabilities().pacing, Pacing::device);
    int beats = 0;
    omni.live(1);
    device->pace([&] {
        now += 1ms;
        sample = device->read(now);
        omni.live(1);
        return ++beats < 50;
    });
    EXPECT_EQ(beats, 50);
    EXPECT_EQ(sample.sequence, 50U);
    sample = device->read(now);
    device->pace([&] { return true; }); // it is silent: this returns
}

TEST_F(OverTheBus, IsOneOfTwo)
{
    FirewireOmni right{testbed, 2, FakeOmni{true, 0x80000003}};
    const auto found = find_omnis();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[1].identity.serial, "00000000001");
    auto first = open_omni("70427300007", {});
    auto second = open_omni("00000000001", {});
    ASSERT_TRUE(first.has_value());
    ASSERT_TRUE(second.has_value());
    for (int ms = 0; ms < 60; ++ms) {
        now += 1ms;
        right.live(1);
        sample = (*second)->read(now);
    }
    EXPECT_TRUE(sample.calibrated);
    omni.live(1);
    EXPECT_FALSE((*first)->read(now).calibrated);
}

} // namespace
} // namespace hapnet::device::omni1394
