// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/device_news.hpp"

#include "device/replay/replay.hpp"
#include "device/simulated/joints/joint_omni.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::peer::monitor {
namespace {

using namespace std::chrono_literals;
using device::CalibrationStep;
using device::Fault;
using device::Latched;
using device::Trip;

constexpr base::TimePoint noon{12h};
constexpr Latched cable{Fault::communication, Trip::device};

constexpr Recovery an_omni{.by_holder = true};

TEST(DeviceReporter, SaysNothingOfADeviceThatIsWell)
{
    DeviceReporter reporter{an_omni};
    for (int ms = 0; ms < 5000; ++ms) {
        EXPECT_FALSE(reporter.look(CalibrationStep::done, {}, noon + ms * 1ms));
    }
}

TEST(DeviceReporter, TellsAFaultAtOnceAndOnceAndItsEnd)
{
    DeviceReporter reporter{an_omni};
    const auto fault = reporter.look(CalibrationStep::done, cable, noon);
    ASSERT_TRUE(fault);
    EXPECT_EQ(describe(*fault),
              "zero force (communication): the device sent data that makes no sense: check its "
              "cable, and use no hub; to feel force again put the stylus into its holder, or hold "
              "it still for a "
              "second and then its button for half a second");
    EXPECT_FALSE(reporter.look(CalibrationStep::done, cable, noon + 5s));
    const auto end = reporter.look(CalibrationStep::done, {}, noon + 6s);
    ASSERT_TRUE(end);
    EXPECT_EQ(describe(*end), "the device is well again: force ramps in");
}

TEST(DeviceReporter, TellsNoMoreThanOnceASecondOfWhatComesAndGoesAndThenHowItIs)
{
    DeviceReporter reporter{an_omni};
    int told = 0;
    for (int ms = 0; ms < 10'000; ++ms) {
        const bool flickers = ms % 2 == 0;
        told += reporter.look(flickers ? CalibrationStep::dock_stylus : CalibrationStep::busy,
                              flickers ? cable : Latched{}, noon + ms * 1ms)
                    ? 1
                    : 0;
    }
    EXPECT_LE(told, 20);
    EXPECT_GE(told, 10);
    const auto last = reporter.look(CalibrationStep::done, {}, noon + 20s);
    EXPECT_TRUE(last);
}

TEST(DeviceReporter, TellsThePersonWhatACalibrationNeeds)
{
    DeviceReporter reporter{an_omni};
    const auto dock = reporter.look(CalibrationStep::dock_stylus, {}, noon);
    ASSERT_TRUE(dock);
    EXPECT_EQ(describe(*dock), device::describe(CalibrationStep::dock_stylus));
    EXPECT_FALSE(reporter.look(CalibrationStep::done, {}, noon + 999ms));
    const auto done = reporter.look(CalibrationStep::done, {}, noon + 1s);
    ASSERT_TRUE(done);
    EXPECT_EQ(describe(*done), "the device is calibrated");
}

TEST(DeviceNews, TellOfEveryFaultWhatHelps)
{
    struct Case {
        Latched fault;
        std::string_view cure;
    };
    for (const Case& c : std::vector<Case>{
             {{Fault::disconnected, Trip::device}, "plug it in and start again"},
             {{Fault::timeout, Trip::silence}, "check its cable and power"},
             {{Fault::timeout, Trip::loop}, "end what keeps the machine busy"},
             {{Fault::communication, Trip::nonsense}, "check its cable, and start again"},
             {{Fault::communication, Trip::device}, "check its cable, and use no hub"},
             {{Fault::over_velocity, Trip::jump}, "check the cable, and calibrate again"},
             {{Fault::over_velocity, Trip::speed}, "hold it still for a second"},
             {{Fault::not_calibrated, Trip::device}, "calibrate it again"},
             {{Fault::overheat, Trip::device}, "let it cool down"},
         }) {
        const std::string said = describe(DeviceNews{.fault = c.fault});
        EXPECT_NE(said.find(c.cure), std::string::npos) << said;
    }
    for (const auto& [fault, cure] : std::vector<std::pair<Fault, std::string_view>>{
             {Fault::permission, "install the udev rules"},
             {Fault::in_use, "end that one first"},
             {Fault::firmware_missing, "give it as a file"},
             {Fault::library_missing, "install it"},
             {Fault::not_found, "hapnet-peer list-devices"},
         }) {
        EXPECT_NE(device::describe(fault).find(cure), std::string_view::npos) << cure;
    }
}

TEST(DeviceNews, PromiseNoWayBackWhereThereIsNone)
{
    for (const Latched& fault : {Latched{Fault::disconnected, Trip::device},
                                 Latched{Fault::communication, Trip::nonsense}}) {
        EXPECT_EQ(describe(DeviceNews{.fault = fault}).find("button"), std::string::npos);
    }
    const auto trip = describe(DeviceNews{.fault = {Fault::over_velocity, Trip::speed}});
    EXPECT_NE(trip.find("button"), std::string::npos);
}

TEST(Recovery, AreThoseOfTheDevice)
{
    const device::JointOmni omni{{}};
    EXPECT_TRUE(recovery_of(omni).by_holder);
    EXPECT_TRUE(recovery_of(omni).by_button);
    EXPECT_TRUE(recovery_of(omni).by_simulated_hand);
    const device::Replay replay{{device::HandMoment{}}, "a file"};
    EXPECT_FALSE(recovery_of(replay).by_holder);
    EXPECT_FALSE(recovery_of(replay).by_simulated_hand);
}

TEST(DeviceNews, AskForNothingThatTheDeviceHasNot)
{
    const auto said = [](const Recovery& recovery) {
        DeviceReporter reporter{recovery};
        return describe(*reporter.look(CalibrationStep::done, cable, noon));
    };
    for (const auto& [recovery, cure] :
         {std::pair{Recovery{},
                    "hold it still for a second, then hold its primary button for half a second"},
          std::pair{Recovery{.by_button = false},
                    "start this program again, as the device has no button"},
          std::pair{Recovery{.by_simulated_hand = true},
                    "the simulated hand holds still for a second, then presses the button"}}) {
        EXPECT_TRUE(said(recovery).ends_with(cure)) << said(recovery);
        for (const char* part : {"stylus", "holder"}) {
            EXPECT_EQ(said(recovery).find(part), std::string::npos) << said(recovery);
        }
    }
    for (const Fault fault : {Fault::over_velocity, Fault::timeout, Fault::overheat}) {
        for (const Trip trip : {Trip::device, Trip::jump, Trip::loop, Trip::speed}) {
            EXPECT_EQ(device::what_happened({fault, trip}).find("stylus"), std::string::npos);
        }
    }
}

TEST(FaultAtTheEnd, IsOneThatNobodyHasEnded)
{
    device::Governor governor{{}};
    EXPECT_EQ(fault_at_the_end(governor), "");
    governor.latch({Fault::disconnected, Trip::device});
    EXPECT_EQ(fault_at_the_end(governor),
              "the session ended at zero force, for a fault of the device (disconnected): the "
              "device has gone: plug it in and start again");
    governor.reset();
    EXPECT_EQ(fault_at_the_end(governor), "");
}

} // namespace
} // namespace hapnet::peer::monitor
