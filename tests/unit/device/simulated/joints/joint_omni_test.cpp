// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/joints/joint_omni.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint opened{1h};

/// A device that is read each millisecond.
struct ReadJoints {
    JointOmni omni;
    base::TimePoint now = opened;
    Sample sample{};

    explicit ReadJoints(InjectedFaults injected_faults = {})
        : omni{{.role = {.task = Task::t3},
                .plant = {},
                .injected_faults = std::move(injected_faults)}}
    {}
    void read_for(base::Duration time)
    {
        for (const base::TimePoint end = now + time; now < end;) {
            now += 1ms;
            sample = omni.read(now);
        }
    }
    void cue()
    {
        omni.on_cue({.start = now + 2s, .hands_on = 10s, .seed = base::Seed{3}, .peer_id = 1});
    }
};

TEST(JointOmni, StartsDockedIsCalibratedByThatAndTakenOutOnItsCue)
{
    ReadJoints reader;
    reader.read_for(40ms);
    EXPECT_TRUE(reader.sample.docked);
    EXPECT_FALSE(reader.sample.calibrated);
    reader.read_for(60ms);
    EXPECT_TRUE(reader.sample.calibrated);
    reader.read_for(2s);
    EXPECT_TRUE(reader.sample.docked);
    reader.cue();
    reader.read_for(1500ms);
    EXPECT_FALSE(reader.sample.docked);
    EXPECT_EQ(reader.sample.fault, Fault::none);
}

TEST(JointOmni, ActsTheTaskThatTheCartesianOneActs)
{
    ReadJoints reader;
    reader.read_for(100ms);
    reader.cue();
    reader.read_for(3s); // T3: it squeezes from the left
    for (int i = 0; i < 50; ++i) {
        reader.read_for(100ms);
        EXPECT_EQ(reader.sample.fault, Fault::none);
        EXPECT_LT(std::abs(reader.sample.hip.y()), 0.01);
        EXPECT_LT(std::abs(reader.sample.hip.z()), 0.02);
    }
}

TEST(JointOmni, GivesWayToAForceInTheHand)
{
    ReadJoints reader;
    reader.read_for(100ms);
    reader.omni.lead_to({});
    reader.read_for(2s);
    const base::Position before = reader.sample.hip;
    for (int ms = 0; ms < 1000; ++ms) {
        reader.omni.apply(ungoverned({{0.0, 2.0, 0.0}}));
        reader.read_for(1ms);
    }
    // 2 N on 200 N/m, less friction, which may have acted in the other direction before.
    EXPECT_NEAR(reader.sample.hip.y() - before.y(), 0.010, 2 * 0.26 / 200);
}

TEST(JointOmni, ReportsNoPositionsButThoseOfWholeCounts)
{
    ReadJoints reader;
    reader.read_for(100ms);
    reader.omni.lead_to({});
    reader.read_for(1500ms);
    const omni::JointRange one_count{0.0, omni::radians_per_count};
    const glm::dvec3 off =
        omni::joints_of(reader.sample.hip).angles - reader.omni.plant().joints().angles;
    // Half a count at its place, and half a count at the dock.
    for (const int joint : {0, 1, 2}) EXPECT_LE(std::abs(off[joint]), one_count.most);
}

TEST(JointOmni, HasTheMishapsThatAreScheduledAndNoOthers)
{
    const auto fault_after = [](InjectedFault::Kind kind) {
        ReadJoints reader{{{{kind, 200ms, 100ms}}}};
        reader.read_for(200ms);
        EXPECT_EQ(reader.sample.fault, Fault::none);
        reader.read_for(50ms);
        return reader.sample.fault;
    };
    EXPECT_EQ(fault_after(InjectedFault::Kind::stall), Fault::timeout);
    EXPECT_EQ(fault_after(InjectedFault::Kind::unplug), Fault::disconnected);
    EXPECT_EQ(fault_after(InjectedFault::Kind::encoder_jump), Fault::not_calibrated);
    EXPECT_EQ(fault_after(InjectedFault::Kind::communication_error), Fault::communication);
    EXPECT_EQ(fault_after(InjectedFault::Kind::dropped_reports), Fault::none);
    ReadJoints reader{{{{InjectedFault::Kind::not_a_number, 200ms, 100ms}}}};
    reader.read_for(250ms);
    EXPECT_TRUE(std::isnan(reader.sample.hip.x()));
    reader.read_for(100ms);
    EXPECT_TRUE(base::is_finite(reader.sample.hip));
}

TEST(JointOmni, IsTheSameAgainFromTheSameSeed)
{
    std::vector<glm::dvec3> places[2];
    for (auto& way : places) {
        ReadJoints reader;
        reader.read_for(100ms);
        reader.cue();
        for (int i = 0; i < 300; ++i) {
            reader.read_for(10ms);
            way.push_back(reader.sample.hip.value);
        }
    }
    EXPECT_EQ(places[0], places[1]);
}

} // namespace
} // namespace hapnet::device
