// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/rig.hpp"
#include "peer/core/side.hpp"
#include "tests/support/device/scripted_hand.hpp"
#include "tests/unit/peer/core/pair.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::peer {
namespace {

/// Two sides whose hands squeeze the cube, and the commands to each.
class SidePair {
public:
    struct Rig {
        [[nodiscard]] const device::Sample& read(base::TimePoint now)
        {
            calls += "read ";
            return rig.read(now);
        }
        base::Force apply(const base::Force& wanted, bool permitted, base::TimePoint now)
        {
            calls += "apply ";
            return rig.apply(wanted, permitted, now);
        }
        [[nodiscard]] device::GovernorState governor_state() const { return rig.governor_state(); }
        void on_cue(const device::Cue& cue)
        {
            calls += "cue ";
            rig.on_cue(cue);
        }
        [[nodiscard]] device::ScriptedHand& hand()
        {
            return dynamic_cast<device::ScriptedHand&>(rig.device());
        }

        device::Rig rig{std::make_unique<device::ScriptedHand>(), device::GovernorLimits{}};
        std::string calls{};
    };

    SidePair()
    {
        rigs[0].hand().sample.hip = {{-0.022, 0.0, 0.0}};
        rigs[1].hand().sample.hip = {{0.022, 0.0, 0.0}};
    }

    void step()
    {
        now += 1ms;
        for (const std::size_t side : {0U, 1U}) {
            while (const auto datagram = sides[1 - side].poll()) {
                sides[side].on_datagram(datagram->bytes(), now);
            }
        }
        for (const std::size_t side : {0U, 1U}) {
            ++rigs[side].hand().sample.sequence;
            rigs[side].calls.clear();
            sides[side].step(now, rigs[side]);
        }
    }
    /// Plays until both have felt the other so long that the governors pass the whole force.
    void run_until_pushing()
    {
        while (sides[0].tick().phase != Phase::running) step();
        for (int tick = 0; tick < 1500; ++tick) step();
    }

    base::TimePoint now{1h};
    std::array<Side, 2> sides{Side{settings_of(0)}, Side{settings_of(1)}};
    std::array<Rig, 2> rigs{};
};

TEST(Side, ReadsItsDeviceBeforeItTellsItTheGovernedForce)
{
    SidePair pair;
    pair.run_until_pushing();
    EXPECT_EQ(pair.rigs[0].calls, "read apply ");
    EXPECT_GT(base::norm(pair.sides[0].told()), 0.1);
    EXPECT_EQ(pair.rigs[0].hand().told, pair.sides[0].told());
    EXPECT_EQ(pair.sides[0].told(), pair.sides[0].tick().force); // below every limit
}

TEST(Side, TellsTheDeviceOfAStartOnceAndAfterTheForce)
{
    SidePair pair;
    std::string cues;
    while (pair.sides[0].tick().phase != Phase::running) {
        pair.step();
        if (pair.rigs[0].calls != "read apply ") cues += pair.rigs[0].calls;
    }
    EXPECT_EQ(cues, "read apply cue ");
    const auto& cue = pair.rigs[0].hand().last_cue;
    ASSERT_TRUE(cue);
    EXPECT_EQ(cue->start, pair.sides[0].peer().session()->start);
    EXPECT_EQ(cue->hands_on, pair.sides[0].peer().hands_on());
    EXPECT_EQ(cue->peer_id, 1);
    EXPECT_TRUE(cue->is_left);
}

TEST(Side, FeelsNothingOfAStylusThatRestsInItsHolder)
{
    SidePair pair;
    pair.run_until_pushing();
    pair.rigs[0].hand().sample.docked = true;
    pair.step();
    EXPECT_FALSE(pair.sides[0].tick().permitted);
    EXPECT_EQ(pair.sides[0].told(), base::Force{});
}

TEST(Side, WritesARowOfAllThatATickDid)
{
    SidePair pair;
    pair.run_until_pushing();
    const Side& side = pair.sides[0];
    const auto row = side.row(7, {.due = pair.now, .late = 3us, .missed_before = 2});
    EXPECT_EQ(row.tick, 7U);
    EXPECT_EQ(row.at(), pair.now + 3us);
    EXPECT_EQ(row.missed_before, 2U);
    EXPECT_EQ(row.sent_sequence, side.tick().sequence);
    EXPECT_EQ(row.phase, record::Phase::running);
    EXPECT_TRUE(row.touching && row.remote_touching && row.remote_fresh);
    EXPECT_EQ(row.cube, side.peer().body().position);
    EXPECT_EQ(row.cube_velocity, side.peer().body().velocity);
    EXPECT_EQ(row.contact, side.tick().force);
    EXPECT_EQ(row.device, side.told());
    EXPECT_EQ(row.remote, side.tick().remote_force);
    EXPECT_EQ(row.governor, static_cast<std::uint8_t>(device::GovernorState::active));
}

TEST(Side, SaysTheWorkOfItsHandOnTheDevice)
{
    SidePair pair;
    pair.run_until_pushing();
    const auto said = [&pair] {
        const auto datagram = pair.sides[0].poll();
        const auto message = wire::decode(datagram->bytes());
        return std::get<wire::State>(*message).work_uj;
    };
    pair.step();
    const std::uint32_t before = said();
    double work_j = 0.0;
    for (int tick = 0; tick < 20; ++tick) { // the hand moves on against the force
        const base::Force told = pair.sides[0].told();
        pair.rigs[0].hand().sample.hip.value.x += 1e-4;
        pair.step();
        work_j -= told.x() * 1e-4;
        if (tick < 19) std::ignore = said();
    }
    EXPECT_GT(work_j, 1e-4);
    EXPECT_NEAR(static_cast<double>(said() - before), 1e6 * work_j, 2.0);
}

TEST(Side, CallsThePhaseAloneWhenTheOtherSideHasLeft)
{
    SidePair pair;
    pair.run_until_pushing();
    pair.sides[1].peer().leave(wire::ByeReason::finished);
    for (int tick = 0; tick < 3; ++tick) pair.step();
    EXPECT_EQ(pair.sides[0].tick().phase, Phase::alone);
    EXPECT_EQ(pair.sides[0].row(0, {}).phase, record::Phase::alone);
}

TEST(SampleOf, GivesTheSampleBackThatWentIntoARow)
{
    device::ScriptedHand* hand = nullptr;
    auto owned = std::make_unique<device::ScriptedHand>();
    hand = owned.get();
    device::Rig rig{std::move(owned), device::GovernorLimits{}};
    hand->sample = {.hip = {{0.01, 0.02, 0.03}},
                    .velocity = {{0.1, 0.2, 0.3}},
                    .gripping = true,
                    .docked = true,
                    .calibrated = false,
                    .fault = device::Fault::timeout,
                    .buttons = 5,
                    .presses = 9,
                    .sequence = 11};
    Side side{settings_of(0)};
    side.step(base::TimePoint{1h}, rig);
    const device::Sample again = sample_of(side.row(0, {}));
    EXPECT_EQ(again.hip, hand->sample.hip);
    EXPECT_EQ(again.velocity, hand->sample.velocity);
    EXPECT_TRUE(again.gripping && again.docked && !again.calibrated);
    EXPECT_EQ(again.fault, device::Fault::timeout);
    EXPECT_EQ(again.buttons, 5);
    EXPECT_EQ(again.presses, 9);
    EXPECT_EQ(again.sequence, 11U);
}

} // namespace
} // namespace hapnet::peer
